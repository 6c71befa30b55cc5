// The tree of names: all of a system that can be looked at or set, by the name that a console gives it.
//
// `mouse.truth.pose.heading` is resolved here and nowhere else, so whoever shows, completes, explains, plots, records,
// sets or serves it finds the same. Nodes are made when somebody asks and keep nothing: each is a few pointers into the
// system, void as soon as that changes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/system/system.hpp"
#include "engine/values/plain_data.hpp"
#include "engine/values/value.hpp"

namespace nezumi {

struct MemberInfo;
struct SetParameter;

/// What a node holds: nothing, a value, or as much of a script's plain data as a limit allows.
using NodeValue = std::variant<std::monostate, Value, PlainSnapshot>;

/// The ports of a component, in-ports first.
std::vector<const Port*> ports_of(const Component& component);

/// "controller.out" and "vx", "[2].x" or "": "controller.out.vx".
std::string join_path(std::string whole, std::string_view part);
/// The first step of a path, "name" or "[2]", which is taken off with the separator ('.' or ':') behind it.
std::string_view take_step(std::string_view& path);

class TreeNode {
public:
    enum class Kind : std::uint8_t {
        system,     ///< its children are components
        component,  ///< its children: members, ports and commands
        ports,      ///< of a component, by name
        port,
        config,  ///< the parameters of a component
        parameter,
        truth,   ///< about a robot
        data,    ///< plain data of a script ("state", "tasks", "probes"): only a look tells what is in it
        value,   ///< any other value, and a part of one
        method,  ///< a member that is called
        command,
    };

    /// The whole system.
    explicit TreeNode(const System& system) : system_(&system) {}

    Kind kind() const;
    /// "mouse.truth.pose": as a recording calls it. A part of a port's value is called as one of the port,
    /// "controller.out.vx", and a parameter "controller.config.speed"; "" of the system.
    std::string path() const { return join_path(whole(), part()); }
    /// What is carried as a whole, "mouse.truth", and which part of it this is, "pose".
    std::string whole() const;
    std::string part() const;
    /// [unit] of a number; "" for none.
    std::string_view unit() const;
    /// What it is, for people; "" where nobody says so.
    std::string_view doc() const;
    /// The type of its value; nullptr where it has none, or only a look tells.
    const Type* type() const;

    /// The child of this name ("speed", "[2]"), or an error that names the nearest.
    Expected<TreeNode> child(std::string_view name) const;
    /// What is at a path below: "out.value.vx". The value of a port may be left out: "out.vx".
    Expected<TreeNode> find(std::string_view path) const;
    /// What `find` takes one step to.
    Expected<TreeNode> step(std::string_view name) const;
    enum class Called : std::uint8_t { either, no, yes };
    /// The names of the children that are called (methods, commands), of those that are not, or of all. Those of a
    /// component, a port and a truth are sorted. Elements of lists have none.
    std::vector<std::string> children(Called called = Called::either) const;

    /// What it holds now. An error where nobody knows, as the truth about a real robot.
    Expected<NodeValue> value(const PlainLimit& limit = {}) const;

    /// The child that can be set by this name, a parameter; or why it can't.
    Expected<TreeNode> to_set(std::string_view name) const;
    /// Of a parameter: the act that sets it.
    SetParameter set(Value value) const;

    const System& system() const { return *system_; }
    // nullptr where it is of none.
    const Component* component() const { return component_; }
    const Robot* robot() const { return dynamic_cast<const Robot*>(component_); }
    const Port* port() const { return port_; }
    const Parameters::Parameter* parameter() const { return parameter_; }
    const MemberInfo* member() const { return member_; }
    const CommandDeclaration* command() const { return command_; }

private:
    Expected<TreeNode> child_of_component(std::string_view name) const;
    Expected<TreeNode> child_of_port(std::string_view name) const;
    Expected<TreeNode> below(std::string_view name) const;
    bool is_of_value() const;
    const Type* whole_type() const;
    const Type::Field* field() const;
    std::vector<std::string> data_names() const;

    const System* system_;
    const Component* component_ = nullptr;
    const Port* port_ = nullptr;
    const MemberInfo* member_ = nullptr;  // of the port, where there is one
    const Parameters::Parameter* parameter_ = nullptr;
    const CommandDeclaration* command_ = nullptr;
    std::string part_{};  // of the value
};

}  // namespace nezumi
