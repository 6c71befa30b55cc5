// Connections and queues of ports of any type, and ports made from the name of a message type.
#include "engine/ports/port.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>

#include "engine/base/list.hpp"

namespace nezumi {

std::optional<Value> default_safe(const MessageType& type) {
    if (type.payload == &type_of<Velocity2D>()) return Velocity2D{};
    return std::nullopt;
}

bool OutPortBase::latch(const Time& now) {
    if (override_ != Override::none) {
        discard();
        if (override_ != Override::dropped) write_any(override_value());
    }
    if (pending_ == 0) return false;
    // The slots of the publication before the last are filled next, so its readers must copy their message now. Readers
    // of the last publication still refer to its slots, because behaviours latch their outputs after their inputs.
    release_slots(sequence_ - 1);
    tm_ = publish(now);
    latched_tick_ = now.tick;
    latched_at_ = now.seconds;
    count_ += latched_;
    ++sequence_;
    return true;
}

void OutPortBase::release_slots(std::uint64_t sequence) const {
    for (InPortBase* reader : readers_) {
        if (reader->looks_at_ == this && reader->looked_sequence_ == sequence) reader->forget_source();
    }
}

void InPortBase::latch(const Time& now) {
    if (override_ != Override::none) {
        skip();
        if (override_ != Override::dropped) take_own(override_value(), now);
        return;
    }
    take_published(now);
    // Injected messages come last, like those of the newest connection. If a sensor writes the port in every tick, an
    // injected message is the latest one for one tick only.
    if (injected_.empty()) return;
    looks_at_ = nullptr;
    for (Value& value : injected_) take_own(std::move(value), now);
    injected_.clear();
}

void InPortBase::take_published(const Time& now) {
    // Sources that published in an earlier tick (behaviours) come before sources of this tick (sensors).
    bool any_of_this_tick = false;
    for (Source& source : sources_) {
        if (source.port->sequence() == source.seen) continue;
        if (source.port->latched_tick() == now.tick) {
            any_of_this_tick = true;
        } else {
            take_source(source, now);
        }
    }
    if (!any_of_this_tick) return;
    for (Source& source : sources_) {
        if (source.port->sequence() != source.seen) take_source(source, now);
    }
}

void InPortBase::take_source(Source& source, const Time& now) {
    source.seen = source.port->sequence();
    looks_at_ = source.port;
    looked_sequence_ = source.seen;
    take_from(*source.port, now);
}

void InPortBase::forget_source() {
    keep_latest();
    looks_at_ = nullptr;
}

void InPortBase::skip() {
    forget_source();
    for (Source& source : sources_) source.seen = source.port->sequence();
    injected_.clear();
}

void InPortBase::clear() {
    skip();
    clear_messages();
    unread_ = 0;
    tm_ = 0;
    arrival_tick_ = -1;
    arrived_at_ = 0;
    arrived_count_ = 0;
}

std::vector<const OutPortBase*> InPortBase::sources() const {
    std::vector<const OutPortBase*> all;
    for (const Source& source : sources_) all.push_back(source.port);
    return all;
}

double InPortBase::stale_after() const {
    double longest = sources_.empty() ? silence : 0;
    for (const Source& source : sources_) longest = std::max(longest, source.port->stale_after());
    return longest;
}

InPortBase::Source* InPortBase::find_source(const OutPortBase& source) {
    return std::find_if(sources_.begin(), sources_.end(), [&](const Source& each) { return each.port == &source; });
}

void InPortBase::attach(OutPortBase& source) {
    assert(source.type() == type());
    if (Source* known = find_source(source); known != sources_.end()) {
        ++known->connections;
        return;
    }
    sources_.push_back({&source, source.sequence()});
    source.readers_.push_back(this);
}

void InPortBase::move_behind(const OutPortBase& source, std::span<const OutPortBase* const> before) {
    const auto is_before = [&](const Source& each) { return contains(before, each.port); };
    Source* own = find_source(source);
    std::rotate(std::find_if_not(sources_.begin(), own, is_before), own, own + 1);
}

void InPortBase::detach(const OutPortBase& source) {
    Source* found = find_source(source);
    if (found == sources_.end() || --found->connections > 0) return;
    if (looks_at_ == &source) forget_source();
    auto& readers = found->port->readers_;
    readers.erase(std::find(readers.begin(), readers.end(), this));
    sources_.erase(found);
    ++disconnections_;
    count_when_left_ = count_;
}

std::vector<AnyMessage> InPortBase::set_queue(std::size_t queue) {
    if (queue == capacity_) return {};
    std::vector<AnyMessage> unread = take_unread();
    set_capacity(queue);
    return set_unread(std::move(unread));
}

void InPortBase::put_back(std::vector<AnyMessage> dropped) {
    if (capacity_ == 0) return;
    overflow_ -= dropped.size();
    std::vector<AnyMessage> unread = take_unread();
    dropped.insert(dropped.end(), std::make_move_iterator(unread.begin()), std::make_move_iterator(unread.end()));
    set_unread(std::move(dropped));
}

// Keeps the newest of these messages, as many as the queue can hold. Returns the others.
std::vector<AnyMessage> InPortBase::set_unread(std::vector<AnyMessage> unread) {
    unread_ = std::min(unread.size(), std::max<std::size_t>(capacity_, 1));
    const auto first = unread.end() - static_cast<std::ptrdiff_t>(unread_);
    fill({std::make_move_iterator(first), std::make_move_iterator(unread.end())});
    unread.erase(first, unread.end());
    overflow_ += unread.size();
    return unread;
}

std::unique_ptr<InPortBase> make_in_port(const MessageType* type, std::string name, std::string doc,
                                         std::size_t queue) {
    return with_payload_type(*type, [&]<class T>() -> std::unique_ptr<InPortBase> {
        return std::make_unique<InPort<T>>(std::move(name), std::move(doc), queue, type);
    });
}

std::unique_ptr<OutPortBase> make_out_port(const MessageType* type, std::string name, std::string doc) {
    return with_payload_type(*type, [&]<class T>() -> std::unique_ptr<OutPortBase> {
        return std::make_unique<OutPort<T>>(std::move(name), std::move(doc), type);
    });
}

Expected<const MessageType*> find_message_type(std::string_view name) {
    for (const MessageType& each : compiled_message_types()) {
        if (each.name == name) return &each;
    }
    return failure("unknown type '" + shown(name) + "'" + did_you_mean(name, compiled_message_names()) +
                   "; `nezumi types` lists them all");
}

}  // namespace nezumi
