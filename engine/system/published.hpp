// The messages that an out-port publishes for robots and programs outside of the system. During an emergency stop,
// velocities are zero.
#pragma once

#include <cstdint>

#include "engine/ports/payload.hpp"
#include "engine/ports/port.hpp"
#include "engine/system/system.hpp"

namespace nezumi {

/// Whether the messages of an out-port may drive robots: the port carries velocities, and is not a robot's own (a robot
/// reports its measured velocity).
bool commands_robots(const System& system, const OutPortBase& port);

/// The messages of an out-port from now on. The system must outlive this object; the port must exist until `follow` is
/// called with another one.
class Published {
public:
    Published(const System& system, const OutPortBase& port)
        : system_(&system),
          port_(&port),
          type_(port.type()),
          seen_(port.sequence()),
          commands_(commands_robots(system, port)) {}

    /// Calls `give` for each message (`MessageView`) that was published since the last call. During an emergency stop,
    /// a velocity that may drive robots is zero, once for each call.
    template <class Give>
    void take(const Give& give) {
        const bool is_new = port_->sequence() != seen_;
        seen_ = port_->sequence();
        if (commands_ && system_->is_stopped()) return give(Message<Velocity2D>{{}, system_->now().seconds}.view());
        if (!is_new) return;
        for (std::size_t i = 0; i < port_->message_count(); ++i) give(port_->message(i));
    }
    const MessageType* type() const { return type_; }
    bool commands() const { return commands_; }
    /// Continues with this port, which has replaced the former port and has the same name and type.
    void follow(const OutPortBase& port) {
        if (&port == port_) return;
        port_ = &port;
        seen_ = 0;
        commands_ = commands_robots(*system_, port);
    }

private:
    const System* system_;
    const OutPortBase* port_;  // may be gone until another one is followed
    const MessageType* type_;
    std::uint64_t seen_;
    bool commands_;
};

}  // namespace nezumi
