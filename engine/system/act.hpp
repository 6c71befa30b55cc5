// Acts: everything that changes a running system from outside, each a value that can be checked, performed, journaled
// and performed again.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/components/parameter.hpp"
#include "engine/ports/messages.hpp"
#include "engine/system/actor.hpp"
#include "engine/system/system_spec.hpp"
#include "engine/values/plain_data.hpp"
#include "engine/values/value.hpp"
#include "engine/world/arena_spec.hpp"

namespace nezumi {

// Ports are "name.port". What an act leaves out is as it is here.

struct SetParameter {
    std::string component;
    std::string parameter;
    Value value;  ///< within its bounds
};
/// A message that is published as if the port's component had written it.
struct Write {
    std::string port;  ///< an out-port; an in-port is injected
    Value value;
};
/// One message as from a connection.
struct Inject {
    std::string port;  ///< an in-port; an out-port is written
    Value value;
};
/// A message that is sent every tick; nothing else gets through.
struct Hold {
    std::string port;
    Value value;
    bool take = false;  ///< also from another who holds it
};
/// A port's hold, drop or freeze ends.
struct Release {
    std::string port;
};
/// Nothing gets through a port any more.
struct Drop {
    std::string port;
};
/// A port is held at its present value.
struct Freeze {
    std::string port;
};
/// INACTIVE to ACTIVE.
struct Activate {
    std::string component;
};
/// ACTIVE to INACTIVE.
struct Deactivate {
    std::string component;
};
/// ERROR to INACTIVE.
struct Reset {
    std::string component;
};
struct Use {
    std::string component;
    std::string set;  ///< one of its named sets of parameters
};
struct Connect {
    std::string from;  ///< an out-port
    std::string to;    ///< an in-port of the same type
};
struct Disconnect {
    std::string from;  ///< an out-port
    std::string to;    ///< an in-port; "": whatever `from`, an out-port or an in-port, is connected to
};
struct Teleport {
    std::string robot;
    Pose2D pose;  ///< where it stands from now on, at rest
};
struct MoveMarker {
    std::string marker;
    Pose3D pose;  ///< where it hangs from now on
};
struct MoveThing {
    std::string thing;  ///< of the arena, as in "box 2"
    Pose2D pose;        ///< of its centre from now on, at rest; its height and tilt stay
};
struct AddMarker {
    MarkerSpec marker;
};
struct RemoveMarker {
    std::string marker;
};
/// Speeds that are forced on a robot, in its frame. What is left out is free; where all are, the disturbance ends.
struct Disturb {
    std::string robot;
    std::optional<double> vx{};  ///< [m/s]
    std::optional<double> vy{};  ///< [m/s]
    std::optional<double> va{};  ///< [rad/s]
};
struct Press {
    std::string robot;
    std::string sensor;   ///< a button or touch sensor
    bool pressed = true;  ///< or let go
};
struct Command {
    std::string component;
    std::string command;
    PlainData arguments;
};
/// Scripts and modules that were saved, or one whose file is replaced by a text.
struct Reload {
    std::vector<std::string> files;  ///< that were saved: everything that comes from one of them
    std::string component;           ///< or, where no file is named: this one, and the others of its file,
    std::string shown;               ///< from a text called so
    std::string text;
};
/// To the version before.
struct Rollback {
    std::string component;
};
struct Add {
    Entry entry;  ///< as a system file gives it
};
struct Remove {
    std::string component;
};
struct Restart {};
struct Stop {};
struct Rearm {};

using Act = std::variant<SetParameter, Write, Inject, Hold, Release, Drop, Freeze, Activate, Deactivate, Reset, Use,
                         Connect, Disconnect, Teleport, MoveMarker, MoveThing, AddMarker, RemoveMarker, Disturb, Press,
                         Command, Reload, Rollback, Add, Remove, Restart, Stop, Rearm>;

/// The names of its members describe an act.
template <class T>
requires is_alternative<T, Act>
inline constexpr bool described_by_names<T> = true;

/// What an act has come to.
struct ActResult {
    PlainData values{};                     ///< that a command returned
    std::vector<std::string> components{};  ///< that run another version now
    int version = 0;                        ///< of the first of them
    std::vector<std::string> notes{};       ///< ports that went, and what they were connected to
};

/// "SetParameter", "Restart", ...
std::string_view name_of(const Act& act);

}  // namespace nezumi
