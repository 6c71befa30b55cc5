// The tree of names: everything of a system that can be read or set, by its name in the console.
//
// `mouse.truth.pose.heading` is resolved only here, so the console, completion, help, plots, recordings and servers all
// find the same value. Nodes are made on demand and store nothing: each has a few pointers into the system, and becomes
// invalid when the system changes.
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

/// The value of a node: nothing, a value, or a part of a script's plain data within a limit.
using NodeValue = std::variant<std::monostate, Value, PlainSnapshot>;

/// The ports of a component, in-ports first.
std::vector<const Port*> ports_of(const Component& component);

/// Joins "controller.out" and "vx", "[2].x" or "": "controller.out.vx".
std::string join_path(std::string whole, std::string_view part);
/// The first step of a path, "name" or "[2]"; removes it with the separator ('.' or ':') after it.
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
        truth,   ///< the true state of a robot
        data,    ///< plain data of a script ("state", "tasks", "probes"): its children are known only after reading
        value,   ///< any other value, or a part of one
        method,  ///< a member that is called
        command,
    };

    /// The root of the tree: the whole system.
    explicit TreeNode(const System& system) : system_(&system) {}

    Kind kind() const;
    /// The name in recordings: "mouse.truth.pose". A part of a port's value is named like a part of the port,
    /// "controller.out.vx", and a parameter "controller.config.speed"; "" for the system.
    std::string path() const { return join_path(whole(), part()); }
    /// The name of the whole value, "mouse.truth", and the path of this part in it, "pose".
    std::string whole() const;
    std::string part() const;
    /// [unit] of a number; "" if there is none.
    std::string_view unit() const;
    /// Documentation; "" if there is none.
    std::string_view doc() const;
    /// The type of the value; nullptr if there is no value, or if the type is known only after reading.
    const Type* type() const;

    /// The child with this name ("speed", "[2]"), or an error with the nearest name.
    Expected<TreeNode> child(std::string_view name) const;
    /// The node at a path below this one: "out.value.vx". The member `value` of a port may be omitted: "out.vx".
    Expected<TreeNode> find(std::string_view path) const;
    /// One step of `find`.
    Expected<TreeNode> step(std::string_view name) const;
    enum class Called : std::uint8_t { either, no, yes };
    /// The names of the children: `yes`: only of methods and commands, `no`: only of the others, `either`: of all. The
    /// names of a component, a port and a truth are sorted. Elements of lists have no names.
    std::vector<std::string> children(Called called = Called::either) const;

    /// The present value. An error if the value is unknown, such as the truth about a real robot.
    Expected<NodeValue> value(const PlainLimit& limit = {}) const { return value_of(part_, limit); }
    /// The present value at a path of fields and elements below this node ("position.x"), without making nodes. Nothing
    /// if there is none.
    Expected<NodeValue> value_at(std::string_view path) const {
        return part_.empty() ? value_of(path, {}) : value_of(join_path(part_, path), {});
    }
    /// Whether all names below are fields and elements of the node's value.
    bool is_value() const { return kind() == Kind::value || kind() == Kind::truth || kind() == Kind::parameter; }

    /// The child with this name, a parameter that can be set; or an error.
    Expected<TreeNode> to_set(std::string_view name) const;
    /// The act that sets this parameter.
    SetParameter set(Value value) const;

    const System& system() const { return *system_; }
    // What the node belongs to; nullptr if there is none.
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
    Expected<NodeValue> value_of(std::string_view part, const PlainLimit& limit) const;
    bool is_of_value() const;
    const Type* whole_type() const;
    const Type::Field* field() const;
    std::vector<std::string> data_names() const;

    const System* system_;
    const Component* component_ = nullptr;
    const Port* port_ = nullptr;
    const MemberInfo* member_ = nullptr;  // of the port, if there is a port
    const Parameters::Parameter* parameter_ = nullptr;
    const CommandDeclaration* command_ = nullptr;
    std::string part_{};               // path in the value
    const Type* part_type_ = nullptr;  // type of the part, if known without reading
};

}  // namespace nezumi
