// Methods of components, and commands of their scripts.
#include <fmt/format.h>

#include "bindings/lua/live/command_arguments.hpp"
#include "bindings/lua/live/object_core.hpp"
#include "bindings/lua/live/robot_acts.hpp"
#include "engine/tree/member.hpp"

namespace nezumi {
namespace {

// The act of a method.
Expected<Act> read_act(lua_State* L, const Objects& objects, const std::string& name, std::string_view method) {
    if (method == "activate") return Activate{name};
    if (method == "deactivate") return Deactivate{name};
    if (method == "reset") return Reset{name};
    if (method == "use") {
        if (lua_type(L, 2) != LUA_TSTRING) return failure(R"(use: expected the name of a set, as in :use "careful")");
        return Use{name, std::string(text_at(L, 2))};
    }
    if (ObjectAccess::hardware(objects))
        return failure(fmt::format("{}: this works only in simulation, and this run drives real robots", method));
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

// Checks that this method of the component can be called, without reading its arguments.
Expected<void> check_call(lua_State* L, const ObjectRef& self, std::string_view name) {
    const auto at = find_component(self);
    if (!at) return Unexpected(at.error());
    const MemberInfo* own = find_member(component_members(), name);
    if (own->robot && dynamic_cast<const Robot*>(at->component) == nullptr)
        return failure(fmt::format("{} is not a robot: it has no '{}'", at->component->name(), name));
    return Arguments{L, 2}.at_most(fmt::format("{}:{}", at->component->name(), name), own->most, own->usage);
}

}  // namespace

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
            if (std::holds_alternative<Use>(*act)) return Answer{Value{at->component->set_in_use()}};
            const bool changes_life = name == "activate" || name == "deactivate" || name == "reset";
            return changes_life ? Answer{Value{std::string(to_text(at->component->state()))}} : Answer{};
        });
    });
}

int call_component_command(lua_State* L) {
    Objects& objects = objects_of(L);
    return answer_beside(L, objects, [&]() -> Expected<Answer> {
        const std::string_view name = text_at(L, lua_upvalueindex(2));
        const auto self = check_self(L, name);
        if (!self) return Unexpected(self.error());
        const ObjectRef& ref = **self;  // stays valid during the call
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

Expected<ComponentAt> find_component(const ObjectRef& ref) {
    const auto node = node_of(ref);
    if (!node) return Unexpected(node.error());
    return ComponentAt{ref.live(), node->component()};
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
