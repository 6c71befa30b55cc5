// The messages between hosts in lockstep for each tick; the CDR format follows from the description.
#pragma once

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "bindings/dds/transport.hpp"
#include "engine/values/describe.hpp"

namespace nezumi::dds {

/// A message of a port.
struct StepMessage {
    std::string port{};  ///< "name.port" of the sender
    Octets payload{};    ///< CDR with its header

    static constexpr std::tuple fields{
        Field{"port", &StepMessage::port, "", "name.port"},
        Field{"payload", &StepMessage::payload, "", "CDR with its header"},
    };
};

/// The result of a host's tick: the messages that its ports have published.
struct Step {
    enum End : std::uint8_t {
        goes_on,
        parts,  ///< the lockstep of the two ends
        ends,   ///< the sender's run is over
    };
    std::uint64_t run = 0;    ///< of the sender
    std::uint64_t to = 0;     ///< run of the receiver
    std::int64_t began = 0;   ///< the sender's tick of the first step
    std::int64_t tick = 0;    ///< the sender's next tick
    std::uint8_t end = 0;     ///< `End`: of the last step
    bool paused = false;      ///< the sender could continue but is paused
    std::string waits_for{};  ///< the host that the sender waits for
    std::vector<StepMessage> messages{};

    static constexpr std::tuple fields{
        Field{"run", &Step::run, "", "of the sender"},
        Field{"to", &Step::to, "", "run of the receiver"},
        Field{"began", &Step::began, "", "the sender's tick of the first step"},
        Field{"tick", &Step::tick, "", "the sender's next one"},
        Field{"end", &Step::end, "", "goes on, parts, ends"},
        Field{"paused", &Step::paused, "", "the sender could go on"},
        Field{"waits_for", &Step::waits_for, "", "a host"},
        Field{"messages", &Step::messages, "", "published in the tick before"},
    };
};

/// The topic of the steps from one host to another.
Topic step_topic(const std::string& from, const std::string& to);

}  // namespace nezumi::dds
