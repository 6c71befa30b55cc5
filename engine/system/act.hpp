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
#include "engine/ports/describe.hpp"
#include "engine/ports/messages.hpp"
#include "engine/system/actor.hpp"
#include "engine/system/system_spec.hpp"
#include "engine/world/arena_spec.hpp"

namespace nezumi {

// Ports are "name.port". What an act leaves out is as it is here.

struct SetParameter {
    std::string component;
    std::string parameter;
    ParameterValue value;
};
struct Write {
    std::string port;
    AnyPayload value;
};
struct Inject {
    std::string port;
    AnyPayload value;
};
struct Hold {
    std::string port;
    AnyPayload value;
    bool take = false;
};
struct Release {
    std::string port;
};
struct Drop {
    std::string port;
};
struct Freeze {
    std::string port;
};
struct Activate {
    std::string component;
};
struct Deactivate {
    std::string component;
};
struct Reset {
    std::string component;
};
struct Use {
    std::string component;
    std::string set;
};
struct Connect {
    std::string from;
    std::string to;
};
struct Disconnect {
    std::string from;
    std::string to;  ///< "": whatever `from`, an out-port or an in-port, is connected to
};
struct Teleport {
    std::string robot;
    Pose2D pose;
};
struct MoveMarker {
    std::string marker;
    Pose3D pose;
};
struct MoveThing {
    std::string thing;
    Pose2D pose;
};
struct AddMarker {
    MarkerSpec marker;
};
struct RemoveMarker {
    std::string marker;
};
struct Disturb {
    std::string robot;
    std::optional<double> vx{};
    std::optional<double> vy{};
    std::optional<double> va{};
};
struct Press {
    std::string robot;
    std::string sensor;
    bool pressed = true;
};
struct Command {
    std::string component;
    std::string command;
    PlainData arguments;
};
struct Reload {
    std::vector<std::string> files;  ///< that were saved: everything that comes from one of them
    std::string component;           ///< or, where no file is named: this one, and the others of its file,
    std::string shown;               ///< from a text called so
    std::string text;
};
struct Rollback {
    std::string component;
};
struct Add {
    Entry entry;
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

/// What an act has come to.
struct ActResult {
    PlainData values{};                     ///< that a command returned
    std::vector<std::string> components{};  ///< that run another version now
    int version = 0;                        ///< of the first of them
    std::vector<std::string> notes{};       ///< ports that went, and what they were connected to
};

template <>
struct Describe<SetParameter> {
    static constexpr std::string_view name = "SetParameter";
    static constexpr std::tuple fields{
        Field{"component", &SetParameter::component, "", "whose parameter"},
        Field{"parameter", &SetParameter::parameter, "", "its name"},
        Field{"value", &SetParameter::value, "", "within its bounds"},
    };
};

template <>
struct Describe<Write> {
    static constexpr std::string_view name = "Write";
    static constexpr std::tuple fields{
        Field{"port", &Write::port, "", "an out-port; an in-port is injected"},
        Field{"value", &Write::value, "", "published as if its component had written it"},
    };
};

template <>
struct Describe<Inject> {
    static constexpr std::string_view name = "Inject";
    static constexpr std::tuple fields{
        Field{"port", &Inject::port, "", "an in-port; an out-port is written"},
        Field{"value", &Inject::value, "", "one message as from a connection"},
    };
};

template <>
struct Describe<Hold> {
    static constexpr std::string_view name = "Hold";
    static constexpr std::tuple fields{
        Field{"port", &Hold::port, "", ""},
        Field{"value", &Hold::value, "", "sent every tick; nothing else gets through"},
        Field{"take", &Hold::take, "", "also from another who holds it"},
    };
};

template <>
struct Describe<Release> {
    static constexpr std::string_view name = "Release";
    static constexpr std::tuple fields{Field{"port", &Release::port, "", "whose hold, drop or freeze ends"}};
};

template <>
struct Describe<Drop> {
    static constexpr std::string_view name = "Drop";
    static constexpr std::tuple fields{Field{"port", &Drop::port, "", "that nothing gets through any more"}};
};

template <>
struct Describe<Freeze> {
    static constexpr std::string_view name = "Freeze";
    static constexpr std::tuple fields{Field{"port", &Freeze::port, "", "that is held at its present value"}};
};

template <>
struct Describe<Activate> {
    static constexpr std::string_view name = "Activate";
    static constexpr std::tuple fields{Field{"component", &Activate::component, "", "INACTIVE to ACTIVE"}};
};

template <>
struct Describe<Deactivate> {
    static constexpr std::string_view name = "Deactivate";
    static constexpr std::tuple fields{Field{"component", &Deactivate::component, "", "ACTIVE to INACTIVE"}};
};

template <>
struct Describe<Reset> {
    static constexpr std::string_view name = "Reset";
    static constexpr std::tuple fields{Field{"component", &Reset::component, "", "ERROR to INACTIVE"}};
};

template <>
struct Describe<Use> {
    static constexpr std::string_view name = "Use";
    static constexpr std::tuple fields{
        Field{"component", &Use::component, "", ""},
        Field{"set", &Use::set, "", "one of its named sets of parameters"},
    };
};

template <>
struct Describe<Connect> {
    static constexpr std::string_view name = "Connect";
    static constexpr std::tuple fields{
        Field{"from", &Connect::from, "", "an out-port"},
        Field{"to", &Connect::to, "", "an in-port of the same type"},
    };
};

template <>
struct Describe<Disconnect> {
    static constexpr std::string_view name = "Disconnect";
    static constexpr std::tuple fields{
        Field{"from", &Disconnect::from, "", "an out-port"},
        Field{"to", &Disconnect::to, "", "an in-port; empty: whatever the first is connected to"},
    };
};

template <>
struct Describe<Teleport> {
    static constexpr std::string_view name = "Teleport";
    static constexpr std::tuple fields{
        Field{"robot", &Teleport::robot, "", ""},
        Field{"pose", &Teleport::pose, "", "where it stands from now on, at rest"},
    };
};

template <>
struct Describe<MoveMarker> {
    static constexpr std::string_view name = "MoveMarker";
    static constexpr std::tuple fields{
        Field{"marker", &MoveMarker::marker, "", ""},
        Field{"pose", &MoveMarker::pose, "", "where it hangs from now on"},
    };
};

template <>
struct Describe<MoveThing> {
    static constexpr std::string_view name = "MoveThing";
    static constexpr std::tuple fields{
        Field{"thing", &MoveThing::thing, "", "of the arena, as in \"box 2\""},
        Field{"pose", &MoveThing::pose, "", "of its centre from now on, at rest; its height and tilt stay"},
    };
};

template <>
struct Describe<AddMarker> {
    static constexpr std::string_view name = "AddMarker";
    static constexpr std::tuple fields{Field{"marker", &AddMarker::marker, "", "as an arena gives it"}};
};

template <>
struct Describe<RemoveMarker> {
    static constexpr std::string_view name = "RemoveMarker";
    static constexpr std::tuple fields{Field{"marker", &RemoveMarker::marker, "", ""}};
};

template <>
struct Describe<Disturb> {
    static constexpr std::string_view name = "Disturb";
    static constexpr std::tuple fields{
        Field{"robot", &Disturb::robot, "", ""},
        Field{"vx", &Disturb::vx, "m/s", "speeds that a hand forces on it, in its frame; free when left out;"},
        Field{"vy", &Disturb::vy, "m/s", "none at all: the hand lets go"},
        Field{"va", &Disturb::va, "rad/s", ""},
    };
};

template <>
struct Describe<Press> {
    static constexpr std::string_view name = "Press";
    static constexpr std::tuple fields{
        Field{"robot", &Press::robot, "", ""},
        Field{"sensor", &Press::sensor, "", "a button or touch sensor"},
        Field{"pressed", &Press::pressed, "", "or let go"},
    };
};

template <>
struct Describe<Command> {
    static constexpr std::string_view name = "Command";
    static constexpr std::tuple fields{
        Field{"component", &Command::component, "", ""},
        Field{"command", &Command::command, "", ""},
        Field{"arguments", &Command::arguments, "", "plain data"},
    };
};

template <>
struct Describe<Reload> {
    static constexpr std::string_view name = "Reload";
    static constexpr std::tuple fields{
        Field{"files", &Reload::files, "", "scripts and modules that were saved"},
        Field{"component", &Reload::component, "", "or one whose file is replaced by a text"},
        Field{"shown", &Reload::shown, "", "what messages call the text"},
        Field{"text", &Reload::text, "", ""},
    };
};

template <>
struct Describe<Rollback> {
    static constexpr std::string_view name = "Rollback";
    static constexpr std::tuple fields{Field{"component", &Rollback::component, "", "to the version before"}};
};

template <>
struct Describe<Add> {
    static constexpr std::string_view name = "Add";
    static constexpr std::tuple fields{Field{"entry", &Add::entry, "", "as a system file gives it"}};
};

template <>
struct Describe<Remove> {
    static constexpr std::string_view name = "Remove";
    static constexpr std::tuple fields{Field{"component", &Remove::component, "", ""}};
};

template <>
struct Describe<Restart> {
    static constexpr std::string_view name = "Restart";
    static constexpr std::tuple<> fields{};
};

template <>
struct Describe<Stop> {
    static constexpr std::string_view name = "Stop";
    static constexpr std::tuple<> fields{};
};

template <>
struct Describe<Rearm> {
    static constexpr std::string_view name = "Rearm";
    static constexpr std::tuple<> fields{};
};

/// "SetParameter", "Restart", ...
std::string_view name_of(const Act& act);

}  // namespace nezumi
