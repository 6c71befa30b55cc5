// Acts: everything that changes a running system from outside, each a value that can be checked, performed, journaled
// and performed again.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

#include "engine/components/parameter.hpp"
#include "engine/components/plain_data.hpp"
#include "engine/ports/messages.hpp"
#include "engine/system/actor.hpp"
#include "engine/system/system_spec.hpp"
#include "engine/values/value.hpp"
#include "engine/world/arena_spec.hpp"

namespace nezumi {

// Ports are "name.port". What an act leaves out is as it is here.

struct SetParameter {
    std::string component;
    std::string parameter;
    ParameterValue value;

    static constexpr std::tuple fields{
        Field{"component", &SetParameter::component, "", "whose parameter"},
        Field{"parameter", &SetParameter::parameter, "", "its name"},
        Field{"value", &SetParameter::value, "", "within its bounds"},
    };
};
struct Write {
    std::string port;
    Value value;

    static constexpr std::tuple fields{
        Field{"port", &Write::port, "", "an out-port; an in-port is injected"},
        Field{"value", &Write::value, "", "published as if its component had written it"},
    };
};
struct Inject {
    std::string port;
    Value value;

    static constexpr std::tuple fields{
        Field{"port", &Inject::port, "", "an in-port; an out-port is written"},
        Field{"value", &Inject::value, "", "one message as from a connection"},
    };
};
struct Hold {
    std::string port;
    Value value;
    bool take = false;

    static constexpr std::tuple fields{
        Field{"port", &Hold::port, "", ""},
        Field{"value", &Hold::value, "", "sent every tick; nothing else gets through"},
        Field{"take", &Hold::take, "", "also from another who holds it"},
    };
};
struct Release {
    std::string port;

    static constexpr std::tuple fields{Field{"port", &Release::port, "", "whose hold, drop or freeze ends"}};
};
struct Drop {
    std::string port;

    static constexpr std::tuple fields{Field{"port", &Drop::port, "", "that nothing gets through any more"}};
};
struct Freeze {
    std::string port;

    static constexpr std::tuple fields{Field{"port", &Freeze::port, "", "that is held at its present value"}};
};
struct Activate {
    std::string component;

    static constexpr std::tuple fields{Field{"component", &Activate::component, "", "INACTIVE to ACTIVE"}};
};
struct Deactivate {
    std::string component;

    static constexpr std::tuple fields{Field{"component", &Deactivate::component, "", "ACTIVE to INACTIVE"}};
};
struct Reset {
    std::string component;

    static constexpr std::tuple fields{Field{"component", &Reset::component, "", "ERROR to INACTIVE"}};
};
struct Use {
    std::string component;
    std::string set;

    static constexpr std::tuple fields{
        Field{"component", &Use::component, "", ""},
        Field{"set", &Use::set, "", "one of its named sets of parameters"},
    };
};
struct Connect {
    std::string from;
    std::string to;

    static constexpr std::tuple fields{
        Field{"from", &Connect::from, "", "an out-port"},
        Field{"to", &Connect::to, "", "an in-port of the same type"},
    };
};
struct Disconnect {
    std::string from;
    std::string to;  ///< "": whatever `from`, an out-port or an in-port, is connected to

    static constexpr std::tuple fields{
        Field{"from", &Disconnect::from, "", "an out-port"},
        Field{"to", &Disconnect::to, "", "an in-port; empty: whatever the first is connected to"},
    };
};
struct Teleport {
    std::string robot;
    Pose2D pose;

    static constexpr std::tuple fields{
        Field{"robot", &Teleport::robot, "", ""},
        Field{"pose", &Teleport::pose, "", "where it stands from now on, at rest"},
    };
};
struct MoveMarker {
    std::string marker;
    Pose3D pose;

    static constexpr std::tuple fields{
        Field{"marker", &MoveMarker::marker, "", ""},
        Field{"pose", &MoveMarker::pose, "", "where it hangs from now on"},
    };
};
struct MoveThing {
    std::string thing;
    Pose2D pose;

    static constexpr std::tuple fields{
        Field{"thing", &MoveThing::thing, "", "of the arena, as in \"box 2\""},
        Field{"pose", &MoveThing::pose, "", "of its centre from now on, at rest; its height and tilt stay"},
    };
};
struct AddMarker {
    MarkerSpec marker;

    static constexpr std::tuple fields{Field{"marker", &AddMarker::marker, "", "as an arena gives it"}};
};
struct RemoveMarker {
    std::string marker;

    static constexpr std::tuple fields{Field{"marker", &RemoveMarker::marker, "", ""}};
};
struct Disturb {
    std::string robot;
    std::optional<double> vx{};
    std::optional<double> vy{};
    std::optional<double> va{};

    static constexpr std::tuple fields{
        Field{"robot", &Disturb::robot, "", ""},
        Field{"vx", &Disturb::vx, "m/s", "speeds that a hand forces on it, in its frame; free when left out;"},
        Field{"vy", &Disturb::vy, "m/s", "none at all: the hand lets go"},
        Field{"va", &Disturb::va, "rad/s", ""},
    };
};
struct Press {
    std::string robot;
    std::string sensor;
    bool pressed = true;

    static constexpr std::tuple fields{
        Field{"robot", &Press::robot, "", ""},
        Field{"sensor", &Press::sensor, "", "a button or touch sensor"},
        Field{"pressed", &Press::pressed, "", "or let go"},
    };
};
struct Command {
    std::string component;
    std::string command;
    PlainData arguments;

    static constexpr std::tuple fields{
        Field{"component", &Command::component, "", ""},
        Field{"command", &Command::command, "", ""},
        Field{"arguments", &Command::arguments, "", "plain data"},
    };
};
struct Reload {
    std::vector<std::string> files;  ///< that were saved: everything that comes from one of them
    std::string component;           ///< or, where no file is named: this one, and the others of its file,
    std::string shown;               ///< from a text called so
    std::string text;

    static constexpr std::tuple fields{
        Field{"files", &Reload::files, "", "scripts and modules that were saved"},
        Field{"component", &Reload::component, "", "or one whose file is replaced by a text"},
        Field{"shown", &Reload::shown, "", "what messages call the text"},
        Field{"text", &Reload::text, "", ""},
    };
};
struct Rollback {
    std::string component;

    static constexpr std::tuple fields{Field{"component", &Rollback::component, "", "to the version before"}};
};
struct Add {
    Entry entry;

    static constexpr std::tuple fields{Field{"entry", &Add::entry, "", "as a system file gives it"}};
};
struct Remove {
    std::string component;

    static constexpr std::tuple fields{Field{"component", &Remove::component, "", ""}};
};
struct Restart {
    static constexpr std::tuple<> fields{};
};
struct Stop {
    static constexpr std::tuple<> fields{};
};
struct Rearm {
    static constexpr std::tuple<> fields{};
};

using Act = std::variant<SetParameter, Write, Inject, Hold, Release, Drop, Freeze, Activate, Deactivate, Reset, Use,
                         Connect, Disconnect, Teleport, MoveMarker, MoveThing, AddMarker, RemoveMarker, Disturb, Press,
                         Command, Reload, Rollback, Add, Remove, Restart, Stop, Rearm>;

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
