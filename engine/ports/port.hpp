// Typed in- and out-ports: a write is invisible until the out-port is latched; a value arrives when the in-port is
// latched. Values are not copied on the way: the writer fills a slot of the out-port, and readers refer to this slot.
#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/few.hpp"
#include "engine/ports/port_base.hpp"

namespace nezumi {

/// A message: a payload and its stamp.
template <class T>
struct Message {
    T data{};
    double tm = 0;  ///< [s]

    MessageView view() const { return {data, tm}; }
};

/// The values of a port: the payload of a compiled message type, or a `Value` for a type from a file.
template <class T>
concept Held = Payload<T> || std::is_same_v<T, Value>;

namespace detail {

// The zero value of a message type.
template <Held T>
struct Zero {
    explicit Zero(const MessageType*) {}
    const T& get() const {
        static const T value{};
        return value;
    }
};
template <>
struct Zero<Value> {
    Value value;
    explicit Zero(const MessageType* type) : value(*type->payload) {}
    const Value& get() const { return value; }
};

template <Held T>
const T& held_in(const Value& value) {
    if constexpr (std::is_same_v<T, Value>) {
        return value;
    } else {
        return value.get<T>();
    }
}
template <Held T>
T held_in(Value&& value) {
    if constexpr (std::is_same_v<T, Value>) {
        return std::move(value);
    } else {
        return std::move(value).get<T>();
    }
}

}  // namespace detail

template <Held T>
class OutPort final : public OutPortBase {
public:
    explicit OutPort(std::string name, std::string doc = "", const MessageType* type = message_of<T>())
        : OutPortBase(std::move(name), type, std::move(doc)), zero_(type) {}

    /// Writes a message, which is invisible until the port is latched. Then in-ports with a queue get every message of
    /// the tick; other in-ports get only the last one.
    void write(const T& value) { next_pending() = value; }
    /// Writes a message like `write`: the caller fills the returned slot, which contains an old payload.
    T& next_pending() {
        Few<Message<T>>& slots = slots_[filling_];
        if (pending_ == slots.size()) slots.push_back({zero_.get()});
        Message<T>& slot = slots[pending_++];
        slot.tm = unstamped;
        return slot.data;
    }
    void stamp(double tm) override {
        assert(pending_ > 0);
        slots_[filling_][pending_ - 1].tm = tm;
    }
    /// Makes `value` the old payload of the first slot that `next_pending` returns in a tick, so that constant parts
    /// are written only once. Call it before the first write.
    void prepare(const T& value) {
        assert(sequence() == 0 && pending_ == 0);
        for (Few<Message<T>>& slots : slots_) {
            if (slots.empty()) slots.push_back({});
            slots[0].data = value;
        }
    }
    /// The value published last; before the first one, the type's zero value.
    const T& read() const { return latched_ > 0 ? published()[latched_ - 1].data : zero_.get(); }
    /// The messages of the last publication, oldest first.
    std::span<const Message<T>> messages() const { return {published().data(), latched_}; }

    void write_any(const Value& value) override { write(detail::held_in<T>(value)); }
    MessageView message(std::size_t index) const override { return messages()[index].view(); }
    Value value() const override { return read(); }
    std::uint64_t hash_latched(std::uint64_t seed) const override {
        for (const Message<T>& message : messages()) seed = mix_payload(seed, message.data);
        return seed;
    }

private:
    double publish(const Time& now) override {
        Few<Message<T>>& slots = slots_[filling_];
        filling_ = next(filling_);
        latched_ = std::exchange(pending_, 0);
        for (std::size_t i = 0; i < latched_; ++i) {
            double& tm = slots[i].tm;
            if (tm == unstamped) tm = now.seconds;
        }
        return slots[latched_ - 1].tm;
    }

    static constexpr double unstamped = std::numeric_limits<double>::infinity();

    // Three places in rotation: one is being filled, the next one has the publication before the last, the third one
    // has the last publication.
    static constexpr std::size_t places = 3;
    static constexpr std::uint32_t next(std::uint32_t place) { return (place + 1) % places; }
    const Few<Message<T>>& published() const { return slots_[next(next(filling_))]; }

    std::uint32_t filling_ = 0;  // the place that is filled
    std::array<Few<Message<T>>, places> slots_;
    [[no_unique_address]] detail::Zero<T> zero_;
};

template <Held T>
class InPort final : public InPortBase {
public:
    explicit InPort(std::string name, std::string doc = "", std::size_t queue = 0,
                    const MessageType* type = message_of<T>())
        : InPortBase(std::move(name), type, std::move(doc), queue), zero_(type) {}

    /// The latest message; with a queue, the oldest unread one (if there is none, the one read last). Only the owner
    /// of the port may call this.
    const Message<T>& take() {
        if (unread_ > 0) {
            --unread_;
            if (capacity_ > 0) {
                if constexpr (holds_heap) queued_bytes_ -= heap_bytes(queue_[head_].data);
                taken_ = std::move(queue_[head_]);
                head_ = (head_ + 1) % capacity_;
            }
        }
        return current();
    }
    /// The payload of `take()`.
    const T& read() { return take().data; }
    /// The last message that `take` returned; without a queue, the latest message.
    const Message<T>& current() const { return capacity_ > 0 ? taken_ : *latest_; }
    /// The latest message that arrived. Does not consume it.
    const Message<T>& latest() const { return *latest_; }
    /// All messages that arrived in the tick `arrival_tick()`, oldest first; empty unless `follow` was called.
    std::span<const Message<T>> messages() const { return {arrived_.data(), arrived_count_}; }

    MessageView message(std::size_t index) const override { return arrived_[index].view(); }
    Value value() const override { return latest_->data; }

private:
    void take_from(const OutPortBase& source, const Time& now) override {
        for (const Message<T>& message : static_cast<const OutPort<T>&>(source).messages()) deliver(message, now);
    }
    void take_own(Value value, const Time& now) override {
        own_ = {detail::held_in<T>(std::move(value)), now.seconds};
        deliver(own_, now);
    }
    void clear_messages() override {
        queued_bytes_ = 0;
        own_ = {zero_.get()};
        taken_ = {zero_.get()};
    }
    void keep_latest() override {
        if (latest_ != &own_) own_ = *latest_;
        latest_ = &own_;
    }
    /// `message` must stay valid until the next `latch` or `keep_latest`.
    void deliver(const Message<T>& message, const Time& now) {
        if (followed_) {
            if (arrival_tick_ != now.tick) arrived_count_ = 0;
            if (arrived_count_ == arrived_.size()) arrived_.emplace_back();
            arrived_[arrived_count_++] = message;
        }
        latest_ = &message;
        tm_ = message.tm;
        arrival_tick_ = now.tick;
        arrived_at_ = now.seconds;
        ++count_;
        if (capacity_ == 0) {
            unread_ = 1;
            return;
        }
        if (queue_.empty()) queue_.resize(capacity_);
        if (unread_ == capacity_) drop_oldest();
        if constexpr (holds_heap) {
            queued_bytes_ += heap_bytes(message.data);
            while (unread_ > 0 && queued_bytes_ > most_queued_bytes) drop_oldest();
        }
        queue_[(head_ + unread_) % capacity_] = message;
        ++unread_;
    }
    void set_capacity(std::size_t queue) override {
        if (capacity_ == 0) taken_ = unread_ > 0 ? Message<T>{zero_.get()} : *latest_;
        capacity_ = queue;
    }
    std::vector<AnyMessage> take_unread() override {
        std::vector<AnyMessage> unread;
        for (std::size_t i = 0; i < unread_; ++i) {
            if (capacity_ == 0) {
                unread.push_back({latest_->data, latest_->tm});
            } else {
                Message<T>& each = queue_[(head_ + i) % capacity_];
                unread.push_back({std::move(each.data), each.tm});
            }
        }
        return unread;
    }
    void fill(std::vector<AnyMessage> unread) override {
        head_ = 0;
        queued_bytes_ = 0;
        queue_.clear();
        queue_.resize(capacity_);
        if (capacity_ == 0) return;
        for (std::size_t i = 0; i < unread.size(); ++i) {
            queue_[i] = {detail::held_in<T>(std::move(unread[i].data)), unread[i].tm};
            queued_bytes_ += heap_bytes(queue_[i].data);
        }
    }
    void drop_oldest() {
        if constexpr (holds_heap) {
            constexpr std::size_t large = 1 << 16;  // a smaller message keeps its memory for the next one
            const std::size_t bytes = heap_bytes(queue_[head_].data);
            queued_bytes_ -= bytes;
            if (bytes > large) {
                T gone = std::move(queue_[head_].data);  // assigning an empty one would keep the memory
            }
        }
        head_ = (head_ + 1) % capacity_;
        --unread_;
        ++overflow_;
    }

    static constexpr bool holds_heap = !std::is_trivially_copyable_v<T>;

    // Members that are used in every tick come first.
    const Message<T>* latest_ = &own_;  // a slot of `looks_at_`, or `own_`
    [[no_unique_address]] detail::Zero<T> zero_;
    Message<T> own_{zero_.get()};    // the latest message, if no source has it
    Message<T> taken_{zero_.get()};  // with a queue: what was read last
    std::vector<Message<T>> queue_;  // a ring of `capacity_`, empty until something arrives
    std::size_t head_ = 0;
    std::size_t queued_bytes_ = 0;     // of texts and sequences in the queue
    std::vector<Message<T>> arrived_;  // the first `arrived_count_`; the others keep their memory for later ones
};

}  // namespace nezumi
