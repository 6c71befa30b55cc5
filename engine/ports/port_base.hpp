// The base classes of ports, for messages of any type.
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
#include "engine/base/few.hpp"
#include "engine/ports/messages.hpp"
#include "engine/ports/payload.hpp"

namespace nezumi {

/// The time for components: a count of ticks, which orders events, and the seconds since the start. In simulation the
/// seconds follow from the count; with real robots they come from a clock.
struct Time {
    std::int64_t tick = 0;
    double seconds = 0;
    std::int64_t left_out = 0;  ///< number of ticks before this one that a stall skipped, with real robots
};

/// [s] A robot stops after this time without a velocity command. A port is stale after this time without a message, if
/// its sender declares no rate.
inline constexpr double silence = 0.5;

enum class Direction : unsigned char { in, out };

/// Changes by a person or a scenario to the messages of a port.
enum class Override : unsigned char {
    none,
    held,     ///< one value is sent every tick and nothing else gets through
    dropped,  ///< nothing gets through
    frozen,   ///< the port's value at the time of `freeze` is sent every tick and nothing else gets through
};

/// A reference to a message of any type in a port.
struct MessageView {
    ValueView data;
    double tm;  ///< [s]
};

class Component;
class InPortBase;

/// The base of all ports, for messages of any type.
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
    /// A note about the port for people, for example that its values are clamped; "" for none.
    const std::string& note() const { return texts_->note; }
    void set_note(std::string note) { texts_->note = std::move(note); }

    /// The last messages, oldest first. Of an out-port: its last publication. Of an in-port, if `follow` was called:
    /// all messages that arrived in the tick `arrival_tick()`.
    virtual std::size_t message_count() const = 0;
    virtual MessageView message(std::size_t index) const = 0;
    /// A copy of the current value: for an in-port the latest arrived value, for an out-port the latest latched value;
    /// before the first message, the type's zero value.
    virtual Value value() const = 0;
    /// The stamp [s] of that value; 0 before the first message.
    double tm() const { return tm_; }
    /// Number of messages since the start.
    std::uint64_t count() const { return count_; }

    /// From now on, sends this value once per tick and blocks all other messages. The value must have the port's type.
    void hold(Value value) {
        held_ = std::make_unique<Value>(std::move(value));
        override_ = Override::held;
    }
    /// Blocks all messages from now on.
    void drop() { override_ = Override::dropped; }
    /// From now on, sends the present value once per tick and blocks all other messages.
    void freeze() {
        held_ = std::make_unique<Value>(value());
        override_ = Override::frozen;
    }
    /// The value that `hold` or `freeze` sends; the port must be held or frozen.
    const Value& override_value() const { return *held_; }
    /// Ends `hold`, `drop` and `freeze`.
    void release() { override_ = Override::none; }

protected:
    Port(std::string name, const MessageType* type, Direction direction, std::string doc)
        : texts_(new Texts{std::move(name), std::move(doc), {}}), type_(type), direction_(direction) {}

    static constexpr double shortest_stale = 0.1;  // [s]
    static constexpr double rounding = 1e-9;       // [s] sums of periods are not exact numbers

private:
    // Data that no tick uses, kept separate from data that ticks use, because the cache can't hold all ports of a
    // thousand robots.
    struct Texts {
        std::string name, doc, note;
    };
    std::unique_ptr<Texts> texts_;

    std::unique_ptr<Value> held_;

protected:
    double tm_ = 0;
    std::uint64_t count_ = 0;

private:
    const MessageType* type_;
    Direction direction_;

protected:
    Override override_ = Override::none;
};

/// The default safe value: standing still for a velocity command, none for other types.
std::optional<Value> default_safe(const MessageType& type);

/// An out-port of any type. One component writes it; any number of in-ports read it.
class OutPortBase : public Port {
public:
    std::size_t message_count() const override { return latched_; }
    /// Publishes the messages written since the last call; a message without its own stamp gets that of `now`. Returns
    /// whether there were any.
    bool latch(const Time& now);
    /// Sets the stamp [s] of the message written last to the time of its measurement. There must be an unpublished
    /// message.
    virtual void stamp(double tm) = 0;
    /// Discards all unpublished messages.
    void discard() { pending_ = 0; }
    /// Writes a value of the port's type.
    virtual void write_any(const Value& value) = 0;
    /// Whether there are unpublished messages.
    bool written() const { return pending_ > 0; }
    /// The number of unpublished messages.
    std::size_t pending() const { return pending_; }
    /// Discards all unpublished messages except the first `count`.
    void discard_after(std::size_t count) { pending_ = pending_ < count ? pending_ : count; }
    /// Whether a safe value is written when the component stops.
    bool has_safe() const { return safe_ != nullptr; }
    /// Writes the safe value for when the component stops, if there is one.
    void write_safe() {
        if (safe_) write_any(*safe_);
    }
    /// Replaces the safe value, which must have the port's type; at first it is `default_safe` of that type.
    void set_safe(std::optional<Value> safe) { safe_ = safe ? std::make_unique<Value>(std::move(*safe)) : nullptr; }
    /// The tick of the last publication; -1 before the first one.
    std::int64_t latched_tick() const { return latched_tick_; }
    /// The rate of publications [Hz] that its owner declares; 0: none is declared.
    double rate() const { return rate_; }
    void set_rate(double hertz) { rate_ = hertz; }
    /// The port is stale after this time [s] without a message: three periods if a rate is declared.
    double stale_after() const { return rate_ > 0 ? std::max(shortest_stale, 3 / rate_) : silence; }
    /// Whether nothing was published for more than `stale_after` before `now` [s], or never.
    bool is_stale(double now) const { return latched_tick_ < 0 || now - latched_at_ > stale_after() + rounding; }
    /// Number of publications since the start.
    std::uint64_t sequence() const { return sequence_; }
    /// Mixes the last publication into a hash.
    virtual std::uint64_t hash_latched(std::uint64_t seed) const = 0;

    /// A second out-port of the same component that belongs to this one, such as the intrinsics of a picture. When an
    /// in-port is connected to this port, the companion of the in-port is connected to the companion of this port.
    OutPortBase* companion() const { return companion_; }
    void set_companion(OutPortBase& companion) { companion_ = &companion; }

protected:
    OutPortBase(std::string name, const MessageType* type, std::string doc)
        : Port(std::move(name), type, Direction::out, std::move(doc)) {
        set_safe(default_safe(*type));
    }
    /// Publishes the pending slots, at least one, and returns the stamp of the last one.
    virtual double publish(const Time& now) = 0;

    std::size_t pending_ = 0;  // how many of the pending slots are filled
    std::size_t latched_ = 0;  // number of messages in the last publication

private:
    friend class InPortBase;
    /// Makes the readers of this publication copy their message. Call it before the slots are reused.
    void release_slots(std::uint64_t sequence) const;

    std::int64_t latched_tick_ = -1;
    double latched_at_ = 0;  // [s]
    std::uint64_t sequence_ = 0;
    double rate_ = 0;
    OutPortBase* companion_ = nullptr;
    Few<InPortBase*> readers_;  // the connected in-ports
    std::unique_ptr<Value> safe_;
};

/// A message of any type.
struct AnyMessage {
    Value data;
    double tm = 0;  ///< [s]
};

/// An in-port of any type. Any number of out-ports of the same type can be connected to it.
class InPortBase : public Port {
public:
    std::size_t message_count() const override { return arrived_count_; }
    /// Takes the new publications of the sources: in the order of ticks, then in the order of the connections.
    void latch(const Time& now);
    /// Discards everything that has arrived: the port is in the state before its first message.
    void clear();
    /// Sends one value as if it came from a connection; it arrives at the next latch, after the messages of its
    /// sources.
    void inject(Value value) { injected_.push_back(std::move(value)); }
    /// Changes the length of the queue (0: only the latest value). Unread messages stay; if they are too many, the
    /// newest stay. Returns the dropped messages, oldest first, and counts them as dropped.
    std::vector<AnyMessage> set_queue(std::size_t queue);
    /// Puts messages back that `set_queue` dropped: before the unread messages. Messages that do not fit stay dropped.
    void put_back(std::vector<AnyMessage> dropped);

    /// Whether there is an unread message.
    bool is_new() const { return unread_ > 0; }
    /// Number of messages dropped because the queue was full.
    std::uint64_t dropped() const { return overflow_; }
    /// True only at the first call, so that the overflow is reported once.
    bool tells_overflow() { return !std::exchange(overflow_told_, true); }
    /// Length of the queue; 0: only the latest value is kept.
    std::size_t queue() const { return capacity_; }
    /// The tick of the last arrival; -1 before the first one.
    std::int64_t arrival_tick() const { return arrival_tick_; }
    /// The time of that tick [s]; 0 before the first one.
    double arrived_at() const { return arrived_at_; }
    /// Whether no message came for at least `silence` before `now` [s].
    bool is_silent(double now) const { return now - arrived_at_ >= silence - rounding; }
    bool connected() const { return !sources_.empty(); }
    /// Whether no message came for more than `stale_after` before `now` [s]. Also true if no message has ever come, or
    /// none since the last connection was removed.
    bool is_stale(double now) const {
        const bool is_left = !connected() && count_ == count_when_left_;
        return is_left || arrival_tick_ < 0 || now - arrived_at_ > stale_after() + rounding;
    }
    /// Number of disconnections from sources.
    std::uint64_t disconnections() const { return disconnections_; }

    /// Connects the port, and its companion to the source's companion if both have the same type. The source comes
    /// after all other sources, or right after those in `before`. If a companion is also connected directly, it is one
    /// source until both connections are removed.
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
    /// Sets the companion of this in-port, which is connected to the companions of the sources.
    void set_companion(InPortBase& companion) { companion_ = &companion; }
    std::vector<const OutPortBase*> sources() const;
    /// The companion of this port, if connecting the port to `source` also connects the companions; otherwise nullptr.
    InPortBase* companion_for(const OutPortBase& source) const {
        const bool both = companion_ != nullptr && source.companion() != nullptr;
        return both && companion_->type() == source.companion()->type() ? companion_ : nullptr;
    }

    /// From now on, keeps all messages that arrived in the tick `arrival_tick()`, for recording.
    void follow() const { followed_ = true; }

    /// The port is stale after this time [s] without a message: the `stale_after` of the slowest source.
    double stale_after() const;
    /// Limit for texts, sequences and pictures in a queue [bytes]. Beyond it the oldest message is dropped, as if the
    /// queue were full.
    static constexpr std::size_t most_queued_bytes = std::size_t{64} << 20;

protected:
    InPortBase(std::string name, const MessageType* type, std::string doc, std::size_t queue)
        : Port(std::move(name), type, Direction::in, std::move(doc)), capacity_(queue) {}

    struct Source {
        OutPortBase* port = nullptr;
        std::uint64_t seen = 0;  // the sequence number of the publication taken last
        int connections = 1;
    };
    /// Takes the last publication of a source.
    virtual void take_from(const OutPortBase& source, const Time& now) = 0;
    /// Takes a message that no source sent.
    virtual void take_own(Value value, const Time& now) = 0;
    /// Discards the messages in this port.
    virtual void clear_messages() = 0;
    /// Copies the latest message into this port.
    virtual void keep_latest() = 0;
    /// Changes `capacity_`; the queue is filled by `fill` afterwards.
    virtual void set_capacity(std::size_t queue) = 0;
    /// Moves the unread messages out, oldest first.
    virtual std::vector<AnyMessage> take_unread() = 0;
    /// Replaces the queue by these messages, at most `capacity_`.
    virtual void fill(std::vector<AnyMessage> unread) = 0;

    // Members that are used in every tick come first.
    const OutPortBase* looks_at_ = nullptr;  // the source whose slot has the latest message; null: this port has it
    std::uint64_t looked_sequence_ = 0;      // the publication of this slot
    Few<Source> sources_;
    std::vector<Value> injected_;
    mutable bool followed_ = false;  // may be set by readers: it does not change the port's behaviour
    std::size_t capacity_;
    std::size_t unread_ = 0;
    std::uint64_t overflow_ = 0;
    std::uint64_t disconnections_ = 0;
    std::uint64_t count_when_left_ = 0;  // the number of messages when the last connection was removed
    std::int64_t arrival_tick_ = -1;
    double arrived_at_ = 0;
    std::size_t arrived_count_ = 0;  // messages in the tick `arrival_tick_`, if `followed_`

private:
    friend class OutPortBase;
    void take_published(const Time& now);
    void take_source(Source& source, const Time& now);
    /// Copies the latest message, so that it no longer refers to a source.
    void forget_source();
    void skip();
    Source* find_source(const OutPortBase& source);
    void attach(OutPortBase& source);
    /// Moves a source forward so that only the sources in `before` come before it.
    void move_behind(const OutPortBase& source, std::span<const OutPortBase* const> before);
    void detach(const OutPortBase& source);
    std::vector<AnyMessage> set_unread(std::vector<AnyMessage> unread);

    InPortBase* companion_ = nullptr;
    bool overflow_told_ = false;
};

std::unique_ptr<InPortBase> make_in_port(const MessageType* type, std::string name, std::string doc, std::size_t queue);
std::unique_ptr<OutPortBase> make_out_port(const MessageType* type, std::string name, std::string doc);

/// Finds a compiled message type by name; the error has the nearest name.
Expected<const MessageType*> find_message_type(std::string_view name);

}  // namespace nezumi
