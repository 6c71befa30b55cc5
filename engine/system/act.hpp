// Acts: all changes of a running system from outside. Each is a value that can be checked, performed, written to a
// journal, and performed again.
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

// Ports are "name.port". Fields that are not given have these defaults.

struct SetParameter {
    std::string component;
    std::string parameter;
    Value value;  ///< within the limits of the parameter
};
/// Publishes a message as if the port's component had written it.
struct Write {
    std::string port;  ///< an out-port; for an in-port, this is an injection
    Value value;
};
/// Delivers one message as from a connection.
struct Inject {
    std::string port;  ///< an in-port; for an out-port, this is a write
    Value value;
};
/// Sends a message in every tick; all other messages are blocked.
struct Hold {
    std::string port;
    Value value;
    bool take = false;  ///< take the port even if another actor holds it
};
/// Ends a hold, drop or freeze of a port.
struct Release {
    std::string port;
};
/// Blocks all messages of a port.
struct Drop {
    std::string port;
};
/// Holds a port at its present value.
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
    std::string set;  ///< one of its parameter sets
};
struct Connect {
    std::string from;  ///< an out-port
    std::string to;    ///< an in-port of the same type
};
struct Disconnect {
    std::string from;  ///< an out-port
    std::string to;    ///< an in-port; "": all ports that `from` (an out-port or an in-port) is connected to
};
struct Teleport {
    std::string robot;
    Pose2D pose;  ///< its new pose, at rest
};
struct MoveMarker {
    std::string marker;
    Pose3D pose;  ///< its new pose
};
struct MoveThing {
    std::string thing;  ///< a thing of the arena, as in "box 2"
    Pose2D pose;        ///< new pose of its centre, at rest; height and tilt do not change
};
struct AddMarker {
    MarkerSpec marker;
};
struct RemoveMarker {
    std::string marker;
};
/// Forces velocities on a robot, in its frame. Omitted ones are free; without any, the disturbance ends.
struct Disturb {
    std::string robot;
    std::optional<double> vx{};  ///< [m/s]
    std::optional<double> vy{};  ///< [m/s]
    std::optional<double> va{};  ///< [rad/s]
};
struct Press {
    std::string robot;
    std::string sensor;   ///< a button or touch sensor
    bool pressed = true;  ///< false: released
};
struct Command {
    std::string component;
    std::string command;
    PlainData arguments;
};
/// Reloads scripts and modules that were saved, or one whose file is replaced by a text.
struct Reload {
    std::vector<std::string> files;  ///< the saved files, whose components are all reloaded
    std::string component;           ///< without `files`: the component whose file is reloaded
    std::string shown;               ///< the name of `text` in messages
    std::string text;                ///< used instead of the content of that file
};
/// Goes back to the previous version of a component's script.
struct Rollback {
    std::string component;
};
struct Add {
    Entry entry;  ///< as in a system file
};
struct Remove {
    std::string component;
};
struct Restart {};
/// Sets a simulated system to its state at a tick, before the acts of that time (`RunningSystem::begin_seek`).
struct Seek {
    std::string branch{};    ///< "main", "branch 1", ...; "": the present one
    std::int64_t tick = -1;  ///< tick of the start; -1: the end of the branch
    int start = 0;           ///< number of the start; 0: the last one of the branch
};
struct Stop {};
struct Rearm {};

using Act = std::variant<SetParameter, Write, Inject, Hold, Release, Drop, Freeze, Activate, Deactivate, Reset, Use,
                         Connect, Disconnect, Teleport, MoveMarker, MoveThing, AddMarker, RemoveMarker, Disturb, Press,
                         Command, Reload, Rollback, Add, Remove, Restart, Seek, Stop, Rearm>;

/// The names of an act's members are its whole description.
template <class T>
requires is_alternative<T, Act>
inline constexpr bool described_by_names<T> = true;

/// The result of an act.
struct ActResult {
    PlainData values{};                     ///< the results of a command
    std::vector<std::string> components{};  ///< the components that run another version now
    int version = 0;                        ///< the new version of the first of them
    std::vector<std::string> notes{};       ///< ports that were removed, with their connections
};

/// "SetParameter", "Restart", ...
std::string_view name_of(const Act& act);
/// "set parameter" of "SetParameter", for messages.
std::string act_in_words(std::string_view name);

/// Whether an act changes a parameter, the state or a task of this component, or calls its command. Acts on ports and
/// on files are not about one component.
bool is_about(const Act& act, std::string_view component);

}  // namespace nezumi
