// The network of a system: ports of other hosts are ports of components whose names contain a slash, "ev3/vehicle".
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
    bool here = false;  ///< the host is connected; false: only a connection names it
    std::string version{};
    std::vector<OfferedPort> ports{};
};

/// Performs an act, like `RunningSystem::act`.
using ActDoor = std::function<Expected<ActResult>(const Act& act, const Actor& who)>;

/// Delivers a message to a port, like `RunningSystem::deliver`.
using MessageDoor = std::function<Expected<ActResult>(const Port& port, const Act& act, const Actor& who)>;

/// Answers a request of another host; `writable`: the host may also change this system.
using QuestionDoor = std::function<Expected<PlainData>(const Question& question, bool writable, const Actor& who)>;

class Network {
public:
    virtual ~Network() = default;
    /// Makes the port "host/name.port" available for a connection to `other`, with its type and the opposite direction,
    /// even if the host is not there yet.
    virtual Expected<void> reach(std::string_view path, const Port& other) = 0;
    /// Called between two ticks, and repeatedly while time is stopped: detects new and missing hosts, makes and ends
    /// the connections that they request, and answers their questions.
    virtual void between_ticks(const ActDoor& act, const QuestionDoor& answer) = 0;
    /// Called once before each tick, after `between_ticks`: writes the received messages to ports, as acts of their
    /// senders.
    virtual void before_tick(const MessageDoor& deliver) = 0;
    /// Hosts that are there or waited for, by name.
    virtual std::vector<Host> hosts() const = 0;
    /// Whether a connection was made by another host or by a word of the system file, and not by `connect` of this
    /// system.
    virtual bool brought(const ConnectionSpec& connection) const = 0;

    // Shared time of several hosts.
    /// Whether the next tick may begin. False while this system waits for other hosts; then call this again.
    virtual bool may_tick() { return true; }
    /// Whether other hosts wait for the ticks of this one.
    virtual bool is_in_lockstep() const { return false; }
    /// Adds the file descriptors that become readable when `may_tick` may have changed.
    virtual void add_files(std::vector<int>& /*files*/) const {}
    /// The run has ended: this system and the others no longer wait for each other.
    virtual void leave() {}

    // Requests change nothing of this system, and do not wait.
    /// Sends a request to a host; returns the number of the request. An error if that host is not there.
    virtual Expected<std::uint64_t> ask(const Question& question) const = 0;
    /// Returns the answer to a request, once, or an error if the host refuses or has not answered in time. Returns
    /// nothing while there is no answer yet; it comes in one of the next calls of `between_ticks`.
    virtual std::optional<Expected<PlainData>> answer(std::uint64_t number) const = 0;
};

/// Makes the network of a system whose file has a word that needs one (`PeerWord::needs_network`). At this time, the
/// system has all its components and no connections.
using NetworkMaker = std::function<Expected<std::unique_ptr<Network>>(const SystemSpec& spec, System& system)>;

}  // namespace nezumi
