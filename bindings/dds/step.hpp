// The messages between hosts in lockstep for each tick; the CDR format follows from the description.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/dds/transport.hpp"
#include "engine/values/describe.hpp"

namespace nezumi::dds {

/// A message of a port.
struct StepMessage {
    std::string port{};  ///< "name.port" of the sender
    Octets payload{};    ///< CDR with its header

    static constexpr std::string_view type_name = "StepMessage";
};

/// The result of a host's tick: the messages that its ports have published.
struct Step {
    enum End : std::uint8_t {
        goes_on,
        parts,  ///< the sender's run goes on, but no longer in lockstep with the receiver
        ends,   ///< the sender's run is over
    };
    std::uint64_t run = 0;                ///< of the sender
    std::uint64_t to = 0;                 ///< run of the receiver
    std::int64_t began = 0;               ///< the sender's tick of the first step
    std::int64_t tick = 0;                ///< the sender's next tick
    std::uint8_t end = 0;                 ///< `End`: whether this is the last step, and why
    bool paused = false;                  ///< the sender waits for no other host
    std::string waits_for{};              ///< the host for which the sender waits
    std::vector<StepMessage> messages{};  ///< published in the tick before

    static constexpr std::string_view type_name = "Step";
};

/// The topic of the steps from one host to another.
Topic step_topic(const std::string& from, const std::string& to);

}  // namespace nezumi::dds
