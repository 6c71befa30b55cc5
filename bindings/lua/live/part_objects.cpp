// The parts of the object model that are lists of names: `X.ports`, `X.config`, `X.truth` and a whole system.
#include <fmt/format.h>

#include <algorithm>

#include "bindings/lua/live/object_core.hpp"
#include "bindings/lua/live/robot_acts.hpp"
#include "bindings/lua/sandbox/ordered.hpp"
#include "bindings/lua/sandbox/text.hpp"
#include "bindings/lua/values/codec.hpp"
#include "engine/live/live_text.hpp"
#include "engine/system/perform.hpp"
#include "engine/trace/channel.hpp"
#include "engine/values/value_text.hpp"

namespace nezumi {
namespace {

// The key at index 2, which must be a text.
Expected<std::string_view> key_of(lua_State* L, std::string_view what) {
    if (lua_type(L, 2) != LUA_TSTRING) return failure(fmt::format("{}: what is in it has a name", what));
    return text_at(L, 2);
}

std::string unknown(std::string_view what, std::string_view name, const std::vector<std::string>& known) {
    const std::vector<std::string_view> names(known.begin(), known.end());
    return fmt::format("{} '{}'{}", what, shown(name), did_you_mean(name, names));
}

template <class Body>
int text_answer(lua_State* L, Body&& body) {
    return answer(L, objects_of(L), [&]() -> Expected<Answer> {
        const auto at = find_component(*to_object(L, 1));
        if (!at) return Answer{at.error().message};
        return Answer{body(*at)};
    });
}

int refuse_truth(lua_State* L) {
    return answer(L, objects_of(L), []() -> Expected<Answer> {
        return failure("what is true can't be set: use teleport for the pose, disturb for the velocity");
    });
}

int refuse_set_part(lua_State* L) {
    return answer(L, objects_of(L), [&]() -> Expected<Answer> {
        const std::string key = lua_type(L, 2) == LUA_TSTRING ? shown(text_at(L, 2)) : "what you name";
        return failure(fmt::format("{} can't be set", key));
    });
}

// X.ports

std::vector<std::string> port_names(const Component& component) {
    std::vector<std::string> names;
    for (const auto& port : component.in_ports()) names.push_back(port->name());
    for (const auto& port : component.out_ports()) names.push_back(port->name());
    return names;
}

int ports_index(lua_State* L) {
    return look(L, objects_of(L), [&]() -> Expected<Answer> {
        const ObjectRef& ref = *to_object(L, 1);
        const auto at = find_component(ref);
        if (!at) return Unexpected(at.error());
        const auto name = key_of(L, "ports");
        if (!name) return Unexpected(name.error());
        if (at->component->find_port(*name) == nullptr)
            return failure(unknown(at->component->name() + " has no port", *name, port_names(*at->component)));
        return Answer{ObjectName{ObjectKind::port, at->live, at->component->name(), std::string(*name)}};
    });
}

int ports_tostring(lua_State* L) {
    return text_answer(L, [](const ComponentAt& at) {
        std::string text;
        for (const std::string& name : port_names(*at.component)) {
            if (!text.empty()) text += "\n";
            text += port_text(*at.live, *at.component, *at.component->find_port(name));
        }
        return text.empty() ? at.component->name() + " has no ports" : text;
    });
}

// X.config

std::vector<std::string> parameter_names(const Component& component) {
    std::vector<std::string> names;
    for (const auto& parameter : component.parameters().all()) names.push_back(parameter.spec.name);
    return names;
}

int config_index(lua_State* L) {
    return look(L, objects_of(L), [&]() -> Expected<Answer> {
        const auto at = find_component(*to_object(L, 1));
        if (!at) return Unexpected(at.error());
        const auto name = key_of(L, "config");
        if (!name) return Unexpected(name.error());
        if (const auto* parameter = at->component->parameters().find(*name)) return Answer{parameter->value};
        return failure(unknown(at->component->name() + ": unknown parameter", *name, parameter_names(*at->component)));
    });
}

int config_newindex(lua_State* L) {
    Objects& objects = objects_of(L);
    return answer_beside(L, objects, [&]() -> Expected<Answer> {
        auto value = read_parameter(L, 3);
        return ObjectAccess::visit(objects, [&]() -> Expected<Answer> {
            const auto at = find_component(*to_object(L, 1));
            if (!at) return Unexpected(at.error());
            const auto name = key_of(L, "config");
            if (!name) return Unexpected(name.error());
            const Component& component = *at->component;
            if (component.parameters().find(*name) == nullptr)
                return failure(unknown(component.name() + ": unknown parameter", *name, parameter_names(component)));
            if (!value) return failure(fmt::format("parameter '{}': {}", *name, value.error().message));
            if (auto ready = ObjectAccess::prepare_change(objects); !ready) return Unexpected(ready.error());
            return answer_of(at->live->act(SetParameter{component.name(), std::string(*name), std::move(*value)},
                                           ObjectAccess::who(objects)));
        });
    });
}

int config_tostring(lua_State* L) {
    return text_answer(L, [](const ComponentAt& at) { return config_text(*at.component); });
}

// X.truth

constexpr std::string_view truth_names[] = {"height", "pose", "tilt", "velocity"};

int truth_index(lua_State* L) {
    return look(L, objects_of(L), [&]() -> Expected<Answer> {
        const auto at = find_component(*to_object(L, 1));
        if (!at) return Unexpected(at.error());
        const auto robot = seen_robot(at->live->system(), *at->component);
        if (!robot) return Unexpected(robot.error());
        const auto name = key_of(L, "truth");
        if (!name) return Unexpected(name.error());
        const Truth truth = seen_truth(*robot->world, robot->id);
        if (*name == "pose") return Answer{truth.pose};
        if (*name == "velocity") return Answer{truth.velocity};
        if (*name == "height") return Answer{truth.height};
        if (*name == "tilt") return Answer{truth.tilt};
        return failure(unknown(at->component->name() + ".truth has no", *name, Objects::truth_members()));
    });
}

int truth_tostring(lua_State* L) {
    return text_answer(L, [](const ComponentAt& at) -> std::string {
        const auto robot = seen_robot(at.live->system(), *at.component);
        if (!robot) return robot.error().message;
        const Truth truth = seen_truth(*robot->world, robot->id);
        return fmt::format("pose = {}\nvelocity = {}\nheight = {:.6g}\ntilt = {:.6g}", short_text(truth.pose),
                           short_text(truth.velocity), truth.height, truth.tilt);
    });
}

// A system

std::vector<std::string> component_names(const System& system) {
    std::vector<std::string> names;
    for (const auto& component : system.components()) names.push_back(component->name());
    return names;
}

int system_index(lua_State* L) {
    return look(L, objects_of(L), [&]() -> Expected<Answer> {
        RunningSystem* live = to_object(L, 1)->live();
        const auto name = key_of(L, "system");
        if (!name) return Unexpected(name.error());
        const auto component = live->system().component(*name);
        if (!component) return Unexpected(component.error());
        return Answer{ObjectName{ObjectKind::component, live, std::string(*name), ""}};
    });
}

int system_tostring(lua_State* L) {
    return answer(L, objects_of(L), [&]() -> Expected<Answer> {
        return Answer{fmt::format("system of {}", fmt::join(component_names(to_object(L, 1)->live()->system()), ", "))};
    });
}

}  // namespace

int pairs_of_names(lua_State* L, Expected<std::vector<std::string>> (*names)(const ObjectRef&)) {
    Objects& objects = objects_of(L);
    lua_settop(L, 1);
    answer(L, objects, [&]() -> Expected<Answer> {
        auto all = names(*to_object(L, 1));
        if (!all) return Unexpected(all.error());
        return Answer{std::move(*all)};
    });
    lua_newtable(L);
    const auto count = static_cast<lua_Integer>(lua_rawlen(L, 2));
    for (lua_Integer i = 1; i <= count; ++i) {
        lua_rawgeti(L, 2, i);
        lua_pushvalue(L, -1);
        lua_gettable(L, 1);
        lua_rawset(L, 3);
    }
    lua_pushcfunction(L, ordered_pairs);
    lua_pushvalue(L, 3);
    lua_call(L, 1, 3);
    return 3;
}

namespace {

template <std::vector<std::string> (*names)(const Component&)>
int component_pairs(lua_State* L) {
    return pairs_of_names(L, [](const ObjectRef& ref) -> Expected<std::vector<std::string>> {
        const auto at = find_component(ref);
        if (!at) return Unexpected(at.error());
        return names(*at->component);
    });
}

int truth_pairs(lua_State* L) {
    return pairs_of_names(
        L, [](const ObjectRef&) -> Expected<std::vector<std::string>> { return Objects::truth_members(); });
}

int system_pairs(lua_State* L) {
    return pairs_of_names(L, [](const ObjectRef& ref) -> Expected<std::vector<std::string>> {
        return component_names(ref.live()->system());
    });
}

}  // namespace

const ObjectFunctions& ports_functions() {
    static constexpr ObjectFunctions functions{ports_index, refuse_set_part, component_pairs<port_names>,
                                               ports_tostring, "ports"};
    return functions;
}

const ObjectFunctions& config_functions() {
    static constexpr ObjectFunctions functions{config_index, config_newindex, component_pairs<parameter_names>,
                                               config_tostring, "config"};
    return functions;
}

const ObjectFunctions& truth_functions() {
    static constexpr ObjectFunctions functions{truth_index, refuse_truth, truth_pairs, truth_tostring, "truth"};
    return functions;
}

const ObjectFunctions& system_functions() {
    static constexpr ObjectFunctions functions{system_index, refuse_set_part, system_pairs, system_tostring, "system"};
    return functions;
}

std::vector<std::string> Objects::truth_members() { return {std::begin(truth_names), std::end(truth_names)}; }

RunningSystem* Objects::to_system(lua_State* L, int index) {
    const ObjectRef* ref = to_object(L, index, ObjectKind::system);
    return ref != nullptr ? ref->live() : nullptr;
}

}  // namespace nezumi
