// The network as a system sees it: ports of other hosts are ports of components whose names have a slash,
// "ev3/vehicle".
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/ports/port_base.hpp"
#include "engine/system/act.hpp"
#include "engine/system/actor.hpp"
#include "engine/system/questions.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

class System;

/// A port that another host offers.
struct OfferedPort {
    std::string name;  ///< "name.port"
    std::string type;  ///< name of its message type
    Direction direction = Direction::out;
};

/// Another host.
struct Host {
    std::string name;
    bool here = false;  ///< or only named by a connection that waits for it
    std::string version{};
    std::vector<OfferedPort> ports{};
};

/// Performs an act as `RunningSystem::act` does.
using ActDoor = std::function<Expected<ActResult>(const Act& act, const Actor& who)>;

/// Has a port take a message, as `RunningSystem::deliver` does.
using MessageDoor = std::function<Expected<ActResult>(const Port& port, const Act& act, const Actor& who)>;

/// Answers what another host asks of this system; `writable`: it may also change something.
using QuestionDoor = std::function<Expected<PlainData>(const Question& question, bool writable, const Actor& who)>;

class Network {
public:
    virtual ~Network() = default;
    /// Makes sure that "host/name.port" is there to be connected to `other`, of its type and in the other direction,
    /// whether or not the host is there yet.
    virtual Expected<void> reach(std::string_view path, const Port& other) = 0;
    /// Between two ticks, again and again while time stands: takes note of hosts that came and went, makes and ends the
    /// connections that they ask for, and answers their questions.
    virtual void between_ticks(const ActDoor& act, const QuestionDoor& answer) = 0;
    /// Once before each tick, after `between_ticks`: has what came for ports written, as acts of who sent it.
    virtual void before_tick(const MessageDoor& deliver) = 0;
    /// Hosts that are there or waited for, by name.
    virtual std::vector<Host> hosts() const = 0;
    /// Whether a connection is there because of something else than a `connect` of this system: another host's, or
    /// the word `ros`.
    virtual bool brought(const ConnectionSpec& connection) const = 0;

    // Time that several hosts share.
    /// Whether the next tick may come. False while others are waited for, to be asked again.
    virtual bool may_tick() { return true; }
    /// Adds the files that are readable when that may have changed.
    virtual void add_files(std::vector<int>& /*files*/) const {}
    /// The run is over: nobody waits for this system any more, nor it for others.
    virtual void leave() {}

    // To ask changes nothing of this system, and waits for nothing.
    /// Asks a host; returns the question's number. An error when that host is not there.
    virtual Expected<std::uint64_t> ask(const Question& question) const = 0;
    /// The answer, once, and an error where the host refuses or has not answered in time; nothing as long as it is to
    /// come, with one of the next `between_ticks`.
    virtual std::optional<Expected<PlainData>> answer(std::uint64_t number) const = 0;
};

/// Makes the network of a system whose file has `network` or `ros`, which has all its components by then and none of
/// its connections.
using NetworkMaker = std::function<Expected<std::unique_ptr<Network>>(const SystemSpec& spec, System& system)>;

}  // namespace nezumi
