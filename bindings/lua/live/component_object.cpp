// `X`: what a component shows and does.
#include <fmt/format.h>

#include <algorithm>

#include "bindings/lua/live/command_arguments.hpp"
#include "bindings/lua/live/object_core.hpp"
#include "bindings/lua/live/robot_acts.hpp"
#include "bindings/lua/sandbox/call.hpp"
#include "bindings/lua/values/member_names.hpp"
#include "engine/live/live_text.hpp"
#include "engine/system/perform.hpp"

namespace nezumi {
namespace {

bool is_robot(const Component& component) { return dynamic_cast<const Robot*>(&component) != nullptr; }

// The member of this name that the component has; null for none.
const MemberName* find_member(const Component& component, std::string_view name) {
    const auto all = member_names();
    const auto found = std::find_if(all.begin(), all.end(), [&](const MemberName& each) { return each.name == name; });
    return found == all.end() || (found->robot && !is_robot(component)) ? nullptr : &*found;
}

std::string status_of(const Component& component) { return std::string(to_text(component.state())); }

Answer now_in(const ComponentAt& at) { return status_of(*at.component); }

// The act that a method means.
Expected<Act> read_act(lua_State* L, const Objects& objects, const std::string& name, std::string_view method) {
    if (method == "activate") return Activate{name};
    if (method == "deactivate") return Deactivate{name};
    if (method == "reset") return Reset{name};
    if (method == "use") {
        if (lua_type(L, 2) != LUA_TSTRING) return failure(R"(use: expected the name of a set, as in :use "careful")");
        return Use{name, std::string(text_at(L, 2))};
    }
    if (ObjectAccess::hardware(objects)) return failure(fmt::format("{}: this is a real robot", method));
    if (method == "teleport") {
        const auto pose = read_pose(L, 2);
        if (!pose) return Unexpected(pose.error());
        return Teleport{name, *pose};
    }
    if (method == "disturb") {
        const auto constraint =
            lua_isnoneornil(L, 2) ? Expected<VelocityConstraint>({}) : read_velocity_constraint(L, 2);
        if (!constraint) return Unexpected(constraint.error());
        return Disturb{name, constraint->vx, constraint->vy, constraint->va};
    }
    if (lua_type(L, 2) != LUA_TSTRING) return failure("press: expected the name of a button");
    if (!lua_isnoneornil(L, 3) && !lua_isboolean(L, 3))
        return failure(fmt::format("press: expected true or false, got {}", Arguments{L}.kind(3)));
    const bool pressed = lua_isnoneornil(L, 3) || lua_toboolean(L, 3) != 0;
    return Press{name, std::string(text_at(L, 2)), pressed};
}

// The object that a method was called on.
Expected<const ObjectRef*> check_self(lua_State* L, std::string_view method) {
    const ObjectRef* self = to_object(L, 1, ObjectKind::component);
    if (self == nullptr)
        return failure(fmt::format("{}: write `X:{}(...)` with a colon, not `X.{}(...)`", method, method, method));
    return self;
}

// A method of this component may be called with what there is; its arguments are not looked at.
Expected<void> check_call(lua_State* L, const ObjectRef& self, std::string_view name) {
    const auto at = find_component(self);
    if (!at) return Unexpected(at.error());
    const MemberName* own = find_member(*at->component, name);
    if (own == nullptr) return failure(fmt::format("{} is no robot: it has no '{}'", at->component->name(), name));
    return Arguments{L, 2}.at_most(fmt::format("{}:{}", at->component->name(), name), own->most, own->usage);
}

int call_component_method(lua_State* L) {
    Objects& objects = objects_of(L);
    return answer_beside(L, objects, [&]() -> Expected<Answer> {
        const std::string_view name = text_at(L, lua_upvalueindex(2));
        const auto self = check_self(L, name);
        if (!self) return Unexpected(self.error());
        const auto act = read_act(L, objects, std::string((*self)->component()), name);
        return ObjectAccess::visit(objects, [&]() -> Expected<Answer> {
            if (auto ok = check_call(L, **self, name); !ok) return Unexpected(ok.error());
            if (!act) return Unexpected(act.error());
            if (auto done = (*self)->live()->act(*act, ObjectAccess::who(objects)); !done)
                return Unexpected(done.error());
            const auto at = find_component(**self);
            if (!at) return Unexpected(at.error());
            if (std::holds_alternative<Use>(*act)) return Answer{at->component->set_in_use()};
            const bool changes_life = name == "activate" || name == "deactivate" || name == "reset";
            return changes_life ? now_in(*at) : Answer{};
        });
    });
}

int command(lua_State* L) {
    Objects& objects = objects_of(L);
    return answer_beside(L, objects, [&]() -> Expected<Answer> {
        const std::string_view name = text_at(L, lua_upvalueindex(2));
        const auto self = check_self(L, name);
        if (!self) return Unexpected(self.error());
        const ObjectRef& ref = **self;  // stays: the call has it
        auto arguments = read_arguments(L, name);
        return ObjectAccess::visit(objects, [&]() -> Expected<Answer> {
            if (auto at = find_component(ref); !at) return Unexpected(at.error());
            if (!arguments) return Unexpected(arguments.error());
            auto done = ref.live()->act(Command{std::string(ref.component()), std::string(name), std::move(*arguments)},
                                        ObjectAccess::who(objects));
            if (!done) return Unexpected(done.error());
            return Answer{std::move(done->values)};
        });
    });
}

// "state", "tasks" or "probes".
Expected<PlainSnapshot> data_of(const ComponentAt& at, std::string_view member, const PlainLimit& limit) {
    const Component& component = *at.component;
    if (member == "state") return component.state_snapshot(limit);
    PlainData data =
        member == "tasks" ? describe(component.tasks()) : describe(component.probes(), at.live->system().now().seconds);
    const std::size_t whole = data.tables.size();
    return PlainSnapshot{std::move(data), whole};
}

Expected<Answer> member_of(const ObjectRef& ref, const ComponentAt& at, std::string_view member) {
    const Component& component = *at.component;
    const auto part = [&](ObjectKind kind) {
        return Answer{ObjectName{kind, at.live, std::string(ref.component()), ""}};
    };
    if (member == "ports") return part(ObjectKind::ports);
    if (member == "config") return part(ObjectKind::config);
    if (member == "truth") {
        if (auto robot = seen_robot(at.live->system(), component); !robot) return Unexpected(robot.error());
        return part(ObjectKind::truth);
    }
    if (member == "name") return Answer{component.name()};
    if (member == "type") return Answer{component.type()};
    if (member == "status") return now_in(at);
    if (member == "version") return Answer{std::int64_t{component.version()}};
    if (member == "state" || member == "tasks" || member == "probes") {
        auto snapshot = data_of(at, member, ObjectAccess::snapshot_limit(*ref.objects));
        if (!snapshot) return Unexpected(snapshot.error());
        return Answer{std::move(*snapshot)};
    }
    if (member == "sets") {
        std::vector<std::string> names;
        for (const auto& [name, values] : component.sets) names.push_back(name);
        return Answer{std::move(names)};
    }
    if (member == "rate") return Answer{component.rate > 0 ? component.rate : at.live->system().settings().rate};
    if (member == "set") {
        if (component.set_in_use().empty()) return Answer{};
        return Answer{component.set_in_use()};
    }
    if (member == "error") {
        if (component.last_error().message.empty()) return Answer{};
        return Answer{describe(component.last_error())};
    }
    std::vector<std::string> names;  // commands
    for (const CommandDeclaration& each : component.commands()) names.push_back(each.name);
    return Answer{std::move(names)};
}

Expected<Answer> robot_member_of(const ComponentAt& at, std::string_view member) {
    const auto& robot = dynamic_cast<const Robot&>(*at.component);
    if (member == "leds") return Answer{robot.leds()};
    if (member == "said") return Answer{std::vector<std::string>(robot.said().begin(), robot.said().end())};
    if (member == "buzzer") return Answer{std::int64_t{robot.buzzer_hertz()}};
    if (member == "limits") {
        const Limits& limits = robot.guard().limits();
        PlainData data = PlainData::empty_table();
        data.tables[0] = {{"acceleration", limits.acceleration},
                          {"speed", limits.speed},
                          {"yaw_acceleration", limits.yaw_acceleration},
                          {"yaw_rate", limits.yaw_rate}};
        return Answer{PlainSnapshot{std::move(data), 1}};
    }
    const auto seen = seen_robot(at.live->system(), *at.component);
    if (!seen) return Unexpected(seen.error());
    if (member == "collided") return Answer{seen->world->collided(seen->id)};
    const std::string touching = seen->world->collided_with(seen->id);
    if (touching.empty()) return Answer{};
    return Answer{touching};
}

Expected<Answer> member(const ObjectRef& ref, const ComponentAt& at, std::string_view name) {
    const Component& component = *at.component;
    const MemberName* own = find_member(component, name);
    const auto own_member = [&]() -> Expected<Answer> {
        if (own->called) return Answer{MethodName{call_component_method, std::string(name)}};
        return own->robot && name != "truth" ? robot_member_of(at, name) : member_of(ref, at, name);
    };
    if (own != nullptr && !own->yields) return own_member();
    if (component.find_port(name) != nullptr)
        return Answer{ObjectName{ObjectKind::port, at.live, component.name(), std::string(name)}};
    for (const CommandDeclaration& each : component.commands()) {
        if (each.name == name) return Answer{MethodName{command, each.name}};
    }
    if (own != nullptr) return own_member();
    if (component.parameters().find(name) != nullptr) {
        return failure(fmt::format("{} has no '{}': its parameter is {}.config.{}", component.name(), shown(name),
                                   component.name(), name));
    }
    const std::vector<std::string> all = Objects::members(component);
    const std::vector<std::string_view> names(all.begin(), all.end());
    return failure(fmt::format("{} has no '{}'{}", component.name(), shown(name), did_you_mean(name, names)));
}

int component_index(lua_State* L) {
    Objects& objects = objects_of(L);
    return look(L, objects, [&]() -> Expected<Answer> {
        const ObjectRef& ref = *to_object(L, 1);
        const auto at = find_component(ref);
        if (!at) return Unexpected(at.error());
        if (lua_type(L, 2) != LUA_TSTRING)
            return failure(fmt::format("{} is a component: its members have names", at->component->name()));
        return member(ref, *at, text_at(L, 2));
    });
}

int component_newindex(lua_State* L) {
    Objects& objects = objects_of(L);
    return answer(L, objects, [&]() -> Expected<Answer> {
        const auto at = find_component(*to_object(L, 1));
        if (!at) return Unexpected(at.error());
        const std::string& name = at->component->name();
        const std::string_view key = lua_type(L, 2) == LUA_TSTRING ? text_at(L, 2) : "?";
        if (at->component->find_port(key) != nullptr) {
            return failure(fmt::format("{}.{} is a port: write a value with {}.{}:write(value)", name, shown(key), name,
                                       shown(key)));
        }
        if (at->component->parameters().find(key) != nullptr) {
            return failure(
                fmt::format("{}.{} can't be set: its parameter is {}.config.{}", name, shown(key), name, shown(key)));
        }
        return failure(
            fmt::format("{}.{} can't be set; parameters can, as in {}.config.NAME = value", name, shown(key), name));
    });
}

int component_pairs(lua_State* L) {
    Objects& objects = objects_of(L);
    return answer(L, objects, [&]() -> Expected<Answer> {
        return failure("a component can't be traversed; its ports and parameters can: pairs(X.ports), pairs(X.config)");
    });
}

int component_tostring(lua_State* L) {
    Objects& objects = objects_of(L);
    return answer(L, objects, [&]() -> Expected<Answer> {
        const ObjectRef& ref = *to_object(L, 1);
        const auto at = find_component(ref);
        if (!at) return Answer{fmt::format("{} (there is no such component now)", ref.component())};
        return Answer{component_text(*at->live, *at->component)};
    });
}

}  // namespace

const ObjectFunctions& component_functions() {
    static constexpr ObjectFunctions functions{component_index, component_newindex, component_pairs, component_tostring,
                                               "component"};
    return functions;
}

std::vector<std::string> Objects::members(const Component& component) {
    std::vector<std::string> all;
    for (const MemberName& each : member_names()) {
        if (!each.robot || is_robot(component)) all.emplace_back(each.name);
    }
    for (const auto& port : component.in_ports()) all.push_back(port->name());
    for (const auto& port : component.out_ports()) all.push_back(port->name());
    for (const CommandDeclaration& each : component.commands()) all.push_back(each.name);
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

std::vector<std::string> Objects::methods(const Component& component) {
    std::vector<std::string> all;
    for (const MemberName& each : member_names()) {
        if (each.called && (!each.robot || is_robot(component))) all.emplace_back(each.name);
    }
    for (const CommandDeclaration& each : component.commands()) all.push_back(each.name);
    std::sort(all.begin(), all.end());
    return all;
}

Expected<ComponentAt> find_component(const ObjectRef& ref) {
    RunningSystem* live = ref.live();
    if (live == nullptr) return failure(fmt::format("the world of '{}' is not built", ref.component()));
    auto found = live->system().component(ref.component());
    if (!found) return Unexpected(found.error());
    return ComponentAt{live, *found};
}

Expected<ComponentAt> Objects::to_component(lua_State* L, int index) const {
    if (const ObjectRef* ref = to_object(L, index, ObjectKind::component)) return find_component(*ref);
    if (lua_type(L, index) != LUA_TSTRING) {
        std::string got(Arguments{L}.kind(index));
        if (to_object(L, index, ObjectKind::port) != nullptr) got = "a port";
        return failure("expected a component or its name, got " + got);
    }
    RunningSystem& live = core_->current();
    auto found = live.system().component(text_at(L, index));
    if (!found) return Unexpected(found.error());
    return ComponentAt{&live, *found};
}

}  // namespace nezumi
