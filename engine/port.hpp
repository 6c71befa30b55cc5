// Typed in- and out-ports: a write is invisible until the out-port is latched, a value arrives when the in-port is
// latched.
#pragma once

#include <cassert>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/error.hpp"
#include "engine/messages.hpp"
#include "engine/payload.hpp"

namespace nezumi {

/// Time as components see it: a count of ticks, and the same in seconds since the start.
struct Time {
    std::int64_t tick = 0;
    double seconds = 0;
};

enum class Direction { in, out };

/// What a person or a scenario may put between a port and its traffic.
enum class Override {
    none,
    held,     ///< one value is sent every tick and nothing else gets through
    dropped,  ///< nothing gets through
    frozen,   ///< the value it had is sent every tick and nothing else gets through
};

class Component;

/// What all ports share, whatever they carry.
class Port {
public:
    Port(const Port&) = delete;
    Port& operator=(const Port&) = delete;
    virtual ~Port() = default;

    const std::string& name() const { return name_; }
    const std::string& doc() const { return doc_; }
    void set_doc(std::string doc) { doc_ = std::move(doc); }
    Direction direction() const { return direction_; }
    /// Place of its message type in `message_types`.
    std::size_t type() const { return type_; }
    std::string_view type_name() const { return message_type_names[type_]; }
    Override override() const { return override_; }
    /// What a person should know about it, for example that its values are clamped; "" for nothing.
    const std::string& note() const { return note_; }
    void set_note(std::string note) { note_ = std::move(note); }

    /// A copy of the value a look shows: of an in-port the latest that arrived, of an out-port the latest that was
    /// latched; the type's zero value before.
    virtual AnyPayload value() const = 0;
    /// The stamp [s] of that value, 0 before any.
    double tm() const { return tm_; }
    /// Messages that passed since the start.
    std::uint64_t count() const { return count_; }

    /// From now on this value, once a tick, and nothing else. It must be of the port's type.
    virtual void hold(AnyPayload value) = 0;
    /// From now on nothing gets through.
    void drop() { override_ = Override::dropped; }
    /// From now on the present value, once a tick, and nothing else.
    virtual void freeze() = 0;
    /// Ends `hold`, `drop` and `freeze`.
    void release() { override_ = Override::none; }

protected:
    Port(std::string name, std::size_t type, Direction direction, std::string doc)
        : name_(std::move(name)), doc_(std::move(doc)), type_(type), direction_(direction) {}

    std::string name_;
    std::string doc_;
    std::string note_;
    double tm_ = 0;
    std::uint64_t count_ = 0;
    std::size_t type_;
    Direction direction_;
    Override override_ = Override::none;
};

/// An out-port of any type. One component writes it, any number of in-ports listen.
class OutPortBase : public Port {
public:
    /// Publishes what was written since the last time, stamped with `now`. Returns whether there was anything.
    virtual bool latch(const Time& now) = 0;
    /// Forgets what was written and not yet published.
    virtual void discard() = 0;
    /// Writes the value that is safe when its component stops, if it has one and wrote nothing itself.
    virtual void write_safe() = 0;
    /// Writes a value of the port's type.
    virtual void write_any(const AnyPayload& value) = 0;
    /// Whether something was written that is not published yet.
    bool written() const { return pending_ > 0; }
    /// How many messages were written that are not published yet.
    std::size_t pending() const { return pending_; }
    /// Forgets all but the first `count` of them.
    void discard_after(std::size_t count) { pending_ = pending_ < count ? pending_ : count; }
    /// Whether a stop of its component writes a safe value.
    virtual bool has_safe() const = 0;
    /// Replaces the value that is safe when its component stops; for null it is the type's own, if that has one.
    virtual void set_safe_any(const AnyPayload* safe) = 0;
    /// The tick in which it published last, -1 before.
    std::int64_t latched_tick() const { return latched_tick_; }
    /// How often it has published.
    std::uint64_t sequence() const { return sequence_; }
    /// Calls `visit(payload)` as an AnyPayload copy for every message of the last publication, oldest first.
    virtual void for_each_latched(const std::function<void(const AnyPayload&)>& visit) const = 0;
    /// Mixes the last publication into a hash.
    virtual std::uint64_t hash_latched(std::uint64_t seed) const = 0;

protected:
    using Port::Port;
    std::size_t pending_ = 0;  // how many of the pending slots are filled
    std::int64_t latched_tick_ = -1;
    std::uint64_t sequence_ = 0;
};

/// An in-port of any type, fed by any number of out-ports of that type.
class InPortBase : public Port {
public:
    /// Takes what its sources have published: in tick order, then in the order of the connections.
    virtual void latch(const Time& now) = 0;
    /// Forgets everything that has arrived: the port is as it was before anything came.
    virtual void clear() = 0;
    /// Sends one value as if it came from a connection; it arrives at the next latch.
    virtual void inject(const AnyPayload& value) = 0;
    /// Gives it a queue of another length (0: the latest value only). What is unread stays, the newest of it if it is
    /// too much.
    virtual void set_queue(std::size_t queue) = 0;

    /// Something unread waits.
    bool is_new() const { return unread_ > 0; }
    /// Messages a full queue has dropped.
    std::uint64_t dropped() const { return overflow_; }
    /// Length of the queue; 0: only the latest value is kept.
    std::size_t queue() const { return capacity_; }
    /// The tick in which something arrived last; -1 before.
    std::int64_t arrival_tick() const { return arrival_tick_; }
    bool connected() const { return connections_ > 0; }

    virtual void connect(OutPortBase& source) = 0;
    virtual void disconnect(const OutPortBase& source) = 0;
    virtual std::vector<const OutPortBase*> sources() const = 0;

    /// How long [s] without a message until `stale`: as long as a robot waits for a velocity.
    static constexpr double stale_after = 0.5;

protected:
    InPortBase(std::string name, std::size_t type, std::string doc, std::size_t queue)
        : Port(std::move(name), type, Direction::in, std::move(doc)), capacity_(queue) {}

    std::size_t capacity_;
    std::size_t unread_ = 0;
    std::size_t connections_ = 0;
    std::uint64_t overflow_ = 0;
    std::int64_t arrival_tick_ = -1;
};

/// A message: a payload and its stamp.
template <class T>
struct Message {
    T data{};
    double tm = 0;  ///< [s]
};

template <Payload T>
class OutPort final : public OutPortBase {
public:
    explicit OutPort(std::string name, std::string doc = "", std::optional<T> safe = default_safe())
        : OutPortBase(std::move(name), type_index<T>(), Direction::out, std::move(doc)), safe_(std::move(safe)) {}

    /// Writes a message. Invisible until the port is latched, then: a queue gets every one of a tick, the others the
    /// last.
    void write(const T& value) { next_pending() = value; }
    /// A slot to fill in place instead of `write`; it holds some old payload.
    T& next_pending() {
        if (pending_ == pending_slots_.size()) pending_slots_.emplace_back();
        return pending_slots_[pending_++].data;
    }
    /// The value published last; T{} before.
    const T& read() const { return latched_ > 0 ? latched_slots_[latched_ - 1].data : zero(); }
    /// The messages of the last publication, oldest first.
    const Message<T>* begin() const { return latched_slots_.data(); }
    const Message<T>* end() const { return latched_slots_.data() + latched_; }

    bool latch(const Time& now) override {
        if (override_ != Override::none) apply_override();
        if (pending_ == 0) return false;
        std::swap(pending_slots_, latched_slots_);
        latched_ = std::exchange(pending_, 0);
        for (std::size_t i = 0; i < latched_; ++i) latched_slots_[i].tm = now.seconds;
        tm_ = now.seconds;
        latched_tick_ = now.tick;
        count_ += latched_;
        ++sequence_;
        return true;
    }
    void discard() override { pending_ = 0; }
    void write_any(const AnyPayload& value) override { write(std::get<T>(value)); }
    bool has_safe() const override { return safe_.has_value(); }
    void set_safe_any(const AnyPayload* safe) override {
        safe_ = safe != nullptr ? std::optional<T>(std::get<T>(*safe)) : default_safe();
    }
    void write_safe() override {
        if (safe_ && pending_ == 0) write(*safe_);
    }
    /// Replaces the value that is safe when its component stops.
    void set_safe(std::optional<T> safe) { safe_ = std::move(safe); }

    AnyPayload value() const override { return read(); }
    void hold(AnyPayload value) override {
        held_ = std::make_unique<T>(std::get<T>(std::move(value)));
        override_ = Override::held;
    }
    void freeze() override {
        held_ = std::make_unique<T>(read());
        override_ = Override::frozen;
    }
    void for_each_latched(const std::function<void(const AnyPayload&)>& visit) const override {
        for (const Message<T>& message : *this) visit(message.data);
    }
    std::uint64_t hash_latched(std::uint64_t seed) const override {
        for (const Message<T>& message : *this) seed = mix_payload(seed, message.data);
        return seed;
    }

private:
    /// A velocity command falls back to standing still.
    static std::optional<T> default_safe() {
        if constexpr (std::is_same_v<T, Velocity2D>) {
            return Velocity2D{};
        } else {
            return std::nullopt;
        }
    }
    static const T& zero() {
        static const T value{};
        return value;
    }
    void apply_override() {
        pending_ = 0;
        if (override_ != Override::dropped) write(*held_);
    }

    std::vector<Message<T>> pending_slots_;
    std::vector<Message<T>> latched_slots_;
    std::size_t latched_ = 0;
    std::optional<T> safe_;
    std::unique_ptr<T> held_;
};

template <Payload T>
class InPort final : public InPortBase {
public:
    explicit InPort(std::string name, std::string doc = "", std::size_t queue = 0)
        : InPortBase(std::move(name), type_index<T>(), std::move(doc), queue) {}

    /// The latest message, or with a queue the oldest unread one (the last one read when none waits). Only the owner
    /// reads.
    const Message<T>& take() {
        if (unread_ > 0) {
            --unread_;
            if (capacity_ > 0) {
                taken_ = std::move(queue_[head_]);
                head_ = (head_ + 1) % capacity_;
            }
        }
        return current();
    }
    /// The payload of `take()`.
    const T& read() { return take().data; }
    /// The message that `take` gave last; without a queue the latest.
    const Message<T>& current() const { return capacity_ > 0 ? taken_ : latest_; }
    /// The latest message that arrived. Consumes nothing.
    const Message<T>& latest() const { return latest_; }

    void latch(const Time& now) override {
        if (override_ != Override::none) {
            skip();
            if (override_ != Override::dropped) deliver({*held_, now.seconds}, now.tick);
            return;
        }
        if (!injected_.empty()) take_injected(now);
        // A source that published in an earlier tick (a behaviour) comes before one of this tick (a sensor).
        bool any_of_this_tick = false;
        for (Source& source : sources_) {
            if (source.port->sequence() == source.seen) continue;
            if (source.port->latched_tick() == now.tick) {
                any_of_this_tick = true;
            } else {
                take_from(source, now);
            }
        }
        if (!any_of_this_tick) return;
        for (Source& source : sources_) {
            if (source.port->sequence() != source.seen) take_from(source, now);
        }
    }
    void clear() override {
        unread_ = 0;
        skip();
        latest_ = {};
        taken_ = {};
        tm_ = 0;
        arrival_tick_ = -1;
    }
    void inject(const AnyPayload& value) override { injected_.push_back({std::get<T>(value), 0.0}); }
    void set_queue(std::size_t queue) override {
        if (queue == capacity_) return;
        std::vector<Message<T>> unread;
        for (std::size_t i = 0; i < unread_; ++i) {
            unread.push_back(capacity_ > 0 ? std::move(queue_[(head_ + i) % capacity_]) : latest_);
        }
        if (capacity_ == 0) taken_ = unread_ > 0 ? Message<T>{} : latest_;
        const std::size_t kept = queue > 0 ? queue : 1;
        if (unread.size() > kept) unread.erase(unread.begin(), unread.end() - static_cast<std::ptrdiff_t>(kept));
        capacity_ = queue;
        head_ = 0;
        unread_ = unread.size();
        queue_ = queue > 0 ? std::move(unread) : std::vector<Message<T>>{};
        queue_.resize(queue);
    }

    AnyPayload value() const override { return latest_.data; }
    void hold(AnyPayload value) override {
        held_ = std::make_unique<T>(std::get<T>(std::move(value)));
        override_ = Override::held;
    }
    void freeze() override {
        held_ = std::make_unique<T>(latest_.data);
        override_ = Override::frozen;
    }

    void connect(OutPortBase& source) override {
        assert(source.type() == type());
        sources_.push_back({static_cast<OutPort<T>*>(&source), source.sequence()});
        connections_ = sources_.size();
    }
    void disconnect(const OutPortBase& source) override {
        std::erase_if(sources_, [&](const Source& s) { return s.port == &source; });
        connections_ = sources_.size();
    }
    std::vector<const OutPortBase*> sources() const override {
        std::vector<const OutPortBase*> all;
        for (const Source& source : sources_) all.push_back(source.port);
        return all;
    }

private:
    struct Source {
        OutPort<T>* port;
        std::uint64_t seen;  // the sequence number of the publication taken last
    };

    void take_from(Source& source, const Time& now) {
        source.seen = source.port->sequence();
        for (const Message<T>& message : *source.port) deliver(message, now.tick);
    }
    void take_injected(const Time& now) {
        for (Message<T>& message : injected_) {
            message.tm = now.seconds;
            deliver(message, now.tick);
        }
        injected_.clear();
    }
    void skip() {
        for (Source& source : sources_) source.seen = source.port->sequence();
        injected_.clear();
    }
    void deliver(const Message<T>& message, std::int64_t tick) {
        latest_ = message;
        tm_ = message.tm;
        arrival_tick_ = tick;
        ++count_;
        if (capacity_ == 0) {
            unread_ = 1;
            return;
        }
        if (queue_.empty()) queue_.resize(capacity_);
        if (unread_ == capacity_) {
            head_ = (head_ + 1) % capacity_;
            --unread_;
            ++overflow_;
        }
        queue_[(head_ + unread_) % capacity_] = message;
        ++unread_;
    }

    std::vector<Source> sources_;
    Message<T> latest_;
    Message<T> taken_;               // with a queue: what was read last
    std::vector<Message<T>> queue_;  // a ring of `capacity_`, empty until something arrives
    std::size_t head_ = 0;
    std::vector<Message<T>> injected_;
    std::unique_ptr<T> held_;
};

/// Makes a port of the message type at this index of `message_types`.
std::unique_ptr<InPortBase> make_in_port(std::size_t type, std::string name, std::string doc, std::size_t queue);
std::unique_ptr<OutPortBase> make_out_port(std::size_t type, std::string name, std::string doc,
                                           std::optional<AnyPayload> safe = std::nullopt);

/// The index of a message type by name, or an error that names the nearest.
Expected<std::size_t> find_message_type(std::string_view name);

}  // namespace nezumi
