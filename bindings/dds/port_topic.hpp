// Messages of a port between hosts: head, stamp and payload as CDR, one topic per out-port.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "bindings/dds/message_age.hpp"
#include "bindings/dds/transport.hpp"
#include "bindings/dds/wire.hpp"
#include "engine/ports/payload.hpp"
#include "engine/ports/port.hpp"
#include "engine/system/published.hpp"
#include "engine/system/system.hpp"
#include "engine/values/cdr.hpp"

namespace nezumi::dds {

/// The topic of the out-port "name.port" of a host with messages of this type.
Topic topic_of(std::string_view host, std::string_view port, const MessageType* type);

/// Updates a map of published ports, by "name.port", to the present ports; drops entries whose port was removed or has
/// another type.
template <class Map>
void follow_ports(Map& all, const System& system) {
    for (auto each = all.begin(); each != all.end();) {
        const auto port = system.port(each->first);
        if (port && (*port)->direction() == Direction::out && (*port)->type() == each->second.type()) {
            each->second.follow(static_cast<const OutPortBase&>(**port));
            ++each;
        } else {
            each = all.erase(each);
        }
    }
}

/// Sends the messages of an out-port while another host needs them.
class Outlet : public Published {
public:
    /// `number`: the number of the last message sent on this topic; counting continues from an earlier outlet. The
    /// variable must outlive this outlet.
    Outlet(const System& system, const OutPortBase& port, std::unique_ptr<Writer> writer, std::uint64_t& number)
        : Published(system, port), writer_(std::move(writer)), number_(number) {}

    /// Sends what was published since the last call. `run`: as announced. `clock`: the monotonic time [s].
    void send(const Time& now, std::uint64_t run, double clock);

private:
    std::unique_ptr<Writer> writer_;
    std::uint64_t& number_;
    Octets bytes_;
};

/// Reads a message of a type, as CDR with header, after the described head. Returns nothing if it is invalid or
/// contains a number that is not finite.
template <class... Head>
std::optional<Value> read_message(const MessageType* type, std::span<const std::uint8_t> bytes, Head&... head) {
    Value value = make_payload(type);
    const CdrFormat format{.order = std::endian::little, .header = true};
    if (!read_cdr(bytes, format, head..., value) || !is_finite(value)) return std::nullopt;
    return value;
}

/// Statistics of received messages.
struct Counts {
    std::uint64_t taken = 0;
    std::uint64_t missed = 0;  ///< sent but not received
    std::uint64_t late = 0;    ///< velocities older than 0.5 s
    std::uint64_t wrong = 0;   ///< invalid for the port's type, with a number that is not finite, or of another run
};

/// The last message taken from a topic: messages that are not newer are repetitions, and rejected.
struct Progress {
    std::optional<std::uint64_t> run{};  ///< of the sender
    std::uint64_t number = 0;            ///< of its last message
};

/// Receives another host's messages for an out-port of this host.
class Inlet {
public:
    using Give = std::function<void(Value value)>;

    /// `type`: of the port. `progress` continues from an earlier inlet of the topic, and must outlive this inlet.
    Inlet(const MessageType* type, std::unique_ptr<Reader> reader, Progress& progress);

    /// Gives the received messages of this run of the other host; others count as wrong. Without `run`, all are wrong.
    void receive(std::optional<std::uint64_t> run, double clock, const Give& give);
    const Counts& counts() const { return counts_; }

private:
    void take(const Octets& bytes, std::uint64_t run, double clock, const Give& give);

    const MessageType* type_;
    std::unique_ptr<Reader> reader_;
    MessageAge age_;
    Progress& progress_;
    Counts counts_;
};

}  // namespace nezumi::dds
