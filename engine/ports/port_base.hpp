// What all ports share, whatever they carry.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/ports/messages.hpp"
#include "engine/ports/payload.hpp"

namespace nezumi {

/// Time as components see it: a count of ticks, which orders what happens, and seconds since the start, which in
/// simulation are that count's and with real robots a clock's.
struct Time {
    std::int64_t tick = 0;
    double seconds = 0;
    std::int64_t left_out = 0;  ///< ticks before this one that a stall of real robots' loop took
};

/// [s] without a velocity command after which a robot stops, and without a message after which a port is stale whose
/// sender declares no rate.
inline constexpr double silence = 0.5;

enum class Direction : unsigned char { in, out };

/// What a person or a scenario may put between a port and its traffic.
enum class Override : unsigned char {
    none,
    held,     ///< one value is sent every tick and nothing else gets through
    dropped,  ///< nothing gets through
    frozen,   ///< the value it had is sent every tick and nothing else gets through
};

/// A message where it lies in a port, of whatever type.
struct MessageView {
    ValueView data;
    double tm;  ///< [s]
};

class Component;

/// What all ports share, whatever they carry.
class Port {
public:
    Port(const Port&) = delete;
    Port& operator=(const Port&) = delete;
    virtual ~Port() = default;

    const std::string& name() const { return texts_->name; }
    const std::string& doc() const { return texts_->doc; }
    void set_doc(std::string doc) { texts_->doc = std::move(doc); }
    Direction direction() const { return direction_; }
    const MessageType* type() const { return type_; }
    std::string_view type_name() const { return type_->name; }
    Override override() const { return override_; }
    /// What a person should know about it, for example that its values are clamped; "" for nothing.
    const std::string& note() const { return texts_->note; }
    void set_note(std::string note) { texts_->note = std::move(note); }

    /// The messages that passed last, oldest first: of an out-port its last publication, of an in-port, while somebody
    /// follows it, all that came in the tick `arrival_tick()`.
    virtual std::size_t message_count() const = 0;
    virtual MessageView message(std::size_t index) const = 0;
    /// A copy of the value a look shows: of an in-port the latest that arrived, of an out-port the latest that was
    /// latched; the type's zero value before.
    virtual Value value() const = 0;
    /// The stamp [s] of that value, 0 before any.
    double tm() const { return tm_; }
    /// Messages that passed since the start.
    std::uint64_t count() const { return count_; }

    /// Sends this value once a tick from now on, and nothing else. It must be of the port's type.
    virtual void hold(Value value) = 0;
    /// From now on nothing gets through.
    void drop() { override_ = Override::dropped; }
    /// Sends the present value once a tick from now on, and nothing else.
    virtual void freeze() = 0;
    /// The value that `hold` or `freeze` sends; the port must be held or frozen.
    virtual Value override_value() const = 0;
    /// Ends `hold`, `drop` and `freeze`.
    void release() { override_ = Override::none; }

protected:
    Port(std::string name, const MessageType* type, Direction direction, std::string doc)
        : texts_(new Texts{std::move(name), std::move(doc), {}}), type_(type), direction_(direction) {}

    static constexpr double shortest_stale = 0.1;  // [s]
    static constexpr double rounding = 1e-9;       // [s] sums of periods are no exact numbers

private:
    // What a tick does not look at, out of the way of what it does: of a thousand robots' ports no cache holds all.
    struct Texts {
        std::string name, doc, note;
    };
    std::unique_ptr<Texts> texts_;

protected:
    double tm_ = 0;
    std::uint64_t count_ = 0;

private:
    const MessageType* type_;
    Direction direction_;

protected:
    Override override_ = Override::none;
};

/// An out-port of any type. One component writes it, any number of in-ports listen.
class OutPortBase : public Port {
public:
    /// Publishes what was written since the last time; what has no stamp of its own gets that of `now`. Returns whether
    /// there was anything.
    virtual bool latch(const Time& now) = 0;
    /// Stamps the message that was written last with a time of its own [s]: when a device measured it. Something must
    /// be written that is not published yet.
    virtual void stamp(double tm) = 0;
    /// Forgets what was written and not yet published.
    virtual void discard() = 0;
    /// Writes the value that is safe when its component stops, if it has one.
    virtual void write_safe() = 0;
    /// Writes a value of the port's type.
    virtual void write_any(const Value& value) = 0;
    /// Whether something was written that is not published yet.
    bool written() const { return pending_ > 0; }
    /// How many messages were written that are not published yet.
    std::size_t pending() const { return pending_; }
    /// Forgets all but the first `count` of them.
    void discard_after(std::size_t count) { pending_ = pending_ < count ? pending_ : count; }
    /// Whether a stop of its component writes a safe value.
    virtual bool has_safe() const = 0;
    /// Replaces the value that is safe when its component stops; for null it is the type's own, if that has one.
    virtual void set_safe_any(const Value* safe) = 0;
    /// The tick in which it published last, -1 before.
    std::int64_t latched_tick() const { return latched_tick_; }
    /// How often [Hz] its owner declares to publish; 0: it does not say.
    double rate() const { return rate_; }
    void set_rate(double hertz) { rate_ = hertz; }
    /// How long [s] without a message until it is stale: three periods where a rate is declared.
    double stale_after() const { return rate_ > 0 ? std::max(shortest_stale, 3 / rate_) : silence; }
    /// Whether nothing was published for longer than that before `now` [s], or never.
    bool is_stale(double now) const { return latched_tick_ < 0 || now - latched_at_ > stale_after() + rounding; }
    /// Number of publications since the start.
    std::uint64_t sequence() const { return sequence_; }
    /// Mixes the last publication into a hash.
    virtual std::uint64_t hash_latched(std::uint64_t seed) const = 0;

    /// A second out-port, of the same component, that explains what this one carries, as intrinsics a picture: an
    /// in-port that is connected to this one has its own companion connected to that one.
    OutPortBase* companion() const { return companion_; }
    void set_companion(OutPortBase& companion) { companion_ = &companion; }

protected:
    using Port::Port;
    std::size_t pending_ = 0;  // how many of the pending slots are filled
    std::int64_t latched_tick_ = -1;
    double latched_at_ = 0;  // [s]
    std::uint64_t sequence_ = 0;
    double rate_ = 0;
    OutPortBase* companion_ = nullptr;
};

/// A message of any type.
struct AnyMessage {
    Value data;
    double tm = 0;  ///< [s]
};

/// An in-port of any type, fed by any number of out-ports of that type.
class InPortBase : public Port {
public:
    /// Takes what its sources have published: in tick order, then in the order of the connections.
    virtual void latch(const Time& now) = 0;
    /// Forgets everything that has arrived: the port is as it was before anything came.
    virtual void clear() = 0;
    /// Sends one value as if it came from a connection; it arrives at the next latch, after what its sources published.
    virtual void inject(const Value& value) = 0;
    /// Gives it a queue of another length (0: the latest value only). What is unread stays, the newest of it if it is
    /// too much. Gives what is dropped, oldest first, and counts it.
    virtual std::vector<AnyMessage> set_queue(std::size_t queue) = 0;
    /// Takes back what `set_queue` has dropped: it comes before what is unread. What is too much now stays dropped.
    virtual void put_back(std::vector<AnyMessage> dropped) = 0;

    /// Something unread waits.
    bool is_new() const { return unread_ > 0; }
    /// Messages a full queue has dropped.
    std::uint64_t dropped() const { return overflow_; }
    /// Whether nobody has told of its overflow yet. From now on somebody has.
    bool tells_overflow() { return !std::exchange(overflow_told_, true); }
    /// Length of the queue; 0: only the latest value is kept.
    std::size_t queue() const { return capacity_; }
    /// The tick in which something arrived last; -1 before.
    std::int64_t arrival_tick() const { return arrival_tick_; }
    /// The time of that tick [s]; 0 before.
    double arrived_at() const { return arrived_at_; }
    bool connected() const { return connections_ > 0; }
    /// Whether nothing came for longer than `stale_after` before `now` [s], ever, or since its last connection went.
    bool is_stale(double now) const {
        const bool is_left = !connected() && count_ == count_when_left_;
        return is_left || arrival_tick_ < 0 || now - arrived_at_ > stale_after() + rounding;
    }
    /// How often it was disconnected from a source.
    std::uint64_t disconnections() const { return disconnections_; }

    /// Connects it, and its companion to the source's, when both have one of the same type. It comes after all other
    /// sources; or, where `before` are those that it follows, right after them. A source that is connected twice, as a
    /// companion and by itself, is one source until both connections have gone.
    void connect(OutPortBase& source) {
        attach(source);
        if (InPortBase* other = companion_for(source)) other->attach(*source.companion());
    }
    void connect(OutPortBase& source, std::span<const OutPortBase* const> before) {
        connect(source);
        move_behind(source, before);
        InPortBase* other = companion_for(source);
        if (other == nullptr) return;
        std::vector<const OutPortBase*> companions;
        for (const OutPortBase* each : before) companions.push_back(each->companion());
        other->move_behind(*source.companion(), companions);
    }
    void disconnect(const OutPortBase& source) {
        detach(source);
        if (InPortBase* other = companion_for(source)) other->detach(*source.companion());
    }
    /// Where the companions of its sources go.
    void set_companion(InPortBase& companion) { companion_ = &companion; }
    virtual std::vector<const OutPortBase*> sources() const = 0;
    /// Its companion, when that is connected to the source's where this is connected to `source`; else nullptr.
    InPortBase* companion_for(const OutPortBase& source) const {
        const bool both = companion_ != nullptr && source.companion() != nullptr;
        return both && companion_->type() == source.companion()->type() ? companion_ : nullptr;
    }

    /// From now on it keeps all messages of its latest arrival, for those who record it.
    void follow() const { followed_ = true; }

    /// How long [s] without a message until it is stale: as long as the slowest of its senders may take.
    virtual double stale_after() const = 0;
    /// Texts, sequences and pictures that wait in a queue are no more than these bytes: beyond them the oldest is
    /// dropped as when the queue is full.
    static constexpr std::size_t most_queued_bytes = std::size_t{64} << 20;

protected:
    virtual void attach(OutPortBase& source) = 0;
    /// Moves a source up to where only these come before it.
    virtual void move_behind(const OutPortBase& source, std::span<const OutPortBase* const> before) = 0;
    virtual void detach(const OutPortBase& source) = 0;

    InPortBase(std::string name, const MessageType* type, std::string doc, std::size_t queue)
        : Port(std::move(name), type, Direction::in, std::move(doc)), capacity_(queue) {}

    mutable bool followed_ = false;  // who looks may ask for it: it changes nothing of what the port does
    std::size_t capacity_;
    std::size_t unread_ = 0;
    std::size_t connections_ = 0;
    std::uint64_t overflow_ = 0;
    std::uint64_t disconnections_ = 0;
    std::uint64_t count_when_left_ = 0;  // the number of messages when its last connection went
    std::int64_t arrival_tick_ = -1;
    double arrived_at_ = 0;

private:
    InPortBase* companion_ = nullptr;
    bool overflow_told_ = false;
};

std::unique_ptr<InPortBase> make_in_port(const MessageType* type, std::string name, std::string doc, std::size_t queue);
std::unique_ptr<OutPortBase> make_out_port(const MessageType* type, std::string name, std::string doc,
                                           std::optional<Value> safe = std::nullopt);

/// A compiled message type by name, or an error that names the nearest.
Expected<const MessageType*> find_message_type(std::string_view name);

}  // namespace nezumi
