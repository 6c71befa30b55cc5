// Messages of one port on their way between hosts: head, stamp and payload as CDR, one topic for each out-port.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "bindings/dds/message_age.hpp"
#include "bindings/dds/transport.hpp"
#include "bindings/dds/wire.hpp"
#include "engine/ports/port_base.hpp"

namespace nezumi::dds {

/// The topic of the out-port "name.port" of a host, whose messages are of this type.
Topic topic_of(std::string_view host, std::string_view port, std::size_t type);

/// Sends what an out-port publishes, while another host wants it.
class Outlet {
public:
    /// `number`: of the message sent last on this topic, which goes on where another outlet has ended. Both references
    /// must outlive the outlet, `port` until another one is followed.
    Outlet(const OutPortBase& port, std::unique_ptr<Writer> writer, std::uint64_t& number)
        : port_(&port), type_(port.type()), writer_(std::move(writer)), seen_(port.sequence()), number_(number) {}

    /// Sends what was published since the last call. `run` as announced; `clock`: the monotonic clock [s].
    void send(const Time& now, std::uint64_t run, double clock);
    std::size_t type() const { return type_; }
    /// The port of the same name and type that has taken the place of the one before.
    void follow(const OutPortBase& port) {
        if (&port == port_) return;
        port_ = &port;
        seen_ = 0;
    }

private:
    const OutPortBase* port_;  // may be gone until another one is followed
    std::size_t type_;
    std::unique_ptr<Writer> writer_;
    std::uint64_t seen_;
    std::uint64_t& number_;
    Octets bytes_;
};

/// What became of the messages that came.
struct Counts {
    std::uint64_t taken = 0;
    std::uint64_t missed = 0;  ///< were sent and never came
    std::uint64_t late = 0;    ///< velocities older than 0.5 s
    std::uint64_t wrong = 0;   ///< no messages of the port's type, with a number that is not finite, or of another run
};

/// How far the messages of a topic were taken: what comes again is older.
struct Progress {
    std::optional<std::uint64_t> run{};  ///< of the sender
    std::uint64_t number = 0;            ///< of the last message of it
};

/// Takes what comes from another host for an out-port of this one.
class Inlet {
public:
    using Give = std::function<void(AnyPayload value)>;

    /// `type`: of the port. `progress` goes on where another inlet has ended, and must outlive it.
    Inlet(std::size_t type, std::unique_ptr<Reader> reader, Progress& progress);

    /// Gives what has come; only what is of this run of the other host counts.
    void receive(std::optional<std::uint64_t> run, double clock, const Give& give);
    const Counts& counts() const { return counts_; }

private:
    void take(const Octets& bytes, std::uint64_t run, double clock, const Give& give);

    std::size_t type_;
    std::unique_ptr<Reader> reader_;
    MessageAge age_;
    Progress& progress_;
    Counts counts_;
};

}  // namespace nezumi::dds
