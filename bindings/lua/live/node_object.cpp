// The objects of the tree of names: a system, its components, their ports and parameters, and the truth about a robot.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "bindings/lua/live/object_core.hpp"
#include "bindings/lua/sandbox/ordered.hpp"
#include "bindings/lua/values/codec.hpp"
#include "engine/live/live_text.hpp"
#include "engine/tree/member.hpp"

namespace nezumi {
namespace {

using NodeKind = TreeNode::Kind;

// The kind of object for a node; nothing for a value or a method.
std::optional<ObjectKind> object_kind(const TreeNode& node) {
    switch (node.kind()) {
        case NodeKind::component: return ObjectKind::component;
        case NodeKind::ports: return ObjectKind::ports;
        case NodeKind::port: return ObjectKind::port;
        case NodeKind::config: return ObjectKind::config;
        case NodeKind::truth: return ObjectKind::truth;
        default: return std::nullopt;
    }
}

Expected<Answer> answer_of(const ObjectRef& ref, const TreeNode& node) {
    const Objects& objects = *ref.objects;
    if (node.kind() == NodeKind::command) return Answer{MethodName{call_component_command, node.command()->name}};
    if (node.kind() == NodeKind::method)
        return Answer{MethodName{node.port() != nullptr ? call_port_method : call_component_method,
                                 std::string(node.member()->name)}};
    const auto kind = object_kind(node);
    if (kind && kind != ObjectKind::truth)
        return Answer{ObjectName{*kind, ref.live(), node.component()->name(), node.port() ? node.port()->name() : ""}};
    if (node.port() != nullptr) ObjectAccess::note_read(objects, {ref.live(), node.component(), node.port()});
    auto value = node.value(ObjectAccess::snapshot_limit(objects));
    if (!value) return Unexpected(value.error());
    if (kind) return Answer{ObjectName{*kind, ref.live(), node.component()->name(), ""}};
    return std::visit([](auto&& held) { return Answer{std::forward<decltype(held)>(held)}; }, std::move(*value));
}

// The error about a key that is not a text.
std::string explain_key(const ObjectRef& ref) {
    switch (ref.kind) {
        case ObjectKind::component:
            return fmt::format("{} is a component: expected the name of a member", ref.component());
        case ObjectKind::port: {
            const std::string path = fmt::format("{}.{}", ref.component(), ref.port());
            return fmt::format("{} is the port, not its value: its value is {}.value", path, path);
        }
        default: return fmt::format("{}: expected the name of a member", node_functions(ref.kind).name);
    }
}

// Pushes the component with the name at index 2 of the system at index 1, the same object each time. Returns false if
// there is none.
bool push_known_component(lua_State* L) {
    Objects& objects = objects_of(L);
    const ObjectRef& ref = *to_object(L, 1);
    if (ref.kind != ObjectKind::system || lua_type(L, 2) != LUA_TSTRING || !ObjectAccess::is_ready(objects))
        return false;
    if (ref.live()->system().find(text_at(L, 2)) == nullptr) return false;
    lua_settop(L, 2);
    if (lua_getiuservalue(L, 1, 1) == LUA_TNIL) {
        lua_newtable(L);
        lua_copy(L, -1, 3);
        lua_setiuservalue(L, 1, 1);
    }
    lua_pushvalue(L, 2);
    if (lua_rawget(L, 3) != LUA_TNIL) return true;
    lua_pop(L, 1);
    push_object(L, objects, ObjectKind::component, *ref.live(), text_at(L, 2), "");
    lua_pushvalue(L, 2);
    lua_pushvalue(L, -2);
    lua_rawset(L, 3);
    return true;
}

int node_index(lua_State* L) {
    if (push_known_component(L)) return 1;
    return look(L, objects_of(L), [&]() -> Expected<Answer> {
        const ObjectRef& ref = *to_object(L, 1);
        const auto node = node_of(ref);
        if (!node) return Unexpected(node.error());
        if (lua_type(L, 2) != LUA_TSTRING) return failure(explain_key(ref));
        const auto child = node->child(text_at(L, 2));
        return child ? answer_of(ref, *child) : Unexpected(child.error());
    });
}

int node_newindex(lua_State* L) {
    Objects& objects = objects_of(L);
    return answer_beside(L, objects, [&]() -> Expected<Answer> {
        const ObjectRef& ref = *to_object(L, 1);
        const bool is_config = ref.kind == ObjectKind::config, has_name = lua_type(L, 2) == LUA_TSTRING;
        auto value = is_config ? read_parameter(L, 3) : Value{};
        return ObjectAccess::visit(objects, [&]() -> Expected<Answer> {
            const auto node = node_of(ref);
            if (!node) return Unexpected(node.error());
            if (is_config && !has_name) return failure(explain_key(ref));
            const auto child = node->to_set(has_name ? text_at(L, 2) : "this member");
            if (!child) return Unexpected(child.error());
            if (!value) return failure(fmt::format("parameter '{}': {}", text_at(L, 2), value.error().message));
            if (auto ready = ObjectAccess::prepare_change(objects); !ready) return Unexpected(ready.error());
            return answer_of(ref.live()->act(child->set(std::move(*value)), ObjectAccess::who(objects)));
        });
    });
}

int node_pairs(lua_State* L) {
    return pairs_of_names(L, [](const ObjectRef& ref) -> Expected<std::vector<std::string>> {
        const auto node = node_of(ref);
        if (!node) return Unexpected(node.error());
        return node->children();
    });
}

int component_pairs(lua_State* L) {
    return answer(L, objects_of(L), []() -> Expected<Answer> {
        return failure("a component can't be traversed; its ports and parameters can: pairs(X.ports), pairs(X.config)");
    });
}

int node_tostring(lua_State* L) {
    return answer(L, objects_of(L), [&]() -> Expected<Answer> {
        const ObjectRef& ref = *to_object(L, 1);
        if (const auto node = node_of(ref)) return Answer{Value{node_text(*node)}};
        std::string gone = fmt::format("{} (there is no such component now)", ref.component());
        if (ref.kind == ObjectKind::port)
            gone = fmt::format("{}.{} (there is no such port now)", ref.component(), ref.port());
        return Answer{Value{std::move(gone)}};
    });
}

}  // namespace

Expected<TreeNode> node_of(const ObjectRef& ref) {
    const RunningSystem* live = ref.live();
    if (live == nullptr) return failure(fmt::format("the world of '{}' is not built", ref.component()));
    if (ref.kind == ObjectKind::system) return live->tree();
    auto node = live->tree().child(ref.component());
    const auto step = [&](std::string_view name) {
        if (node) node = node->child(name);
    };
    switch (ref.kind) {
        case ObjectKind::config: step("config"); break;
        case ObjectKind::truth: step("truth"); break;
        case ObjectKind::port: step("ports"), step(ref.port()); break;
        case ObjectKind::ports: step("ports"); break;
        default: break;
    }
    return node;
}

int pairs_of_names(lua_State* L, Expected<std::vector<std::string>> (*names)(const ObjectRef&)) {
    Objects& objects = objects_of(L);
    lua_settop(L, 1);
    answer(L, objects, [&]() -> Expected<Answer> {
        auto all = names(*to_object(L, 1));
        if (!all) return Unexpected(all.error());
        return Answer{Value{std::move(*all)}};
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

ObjectFunctions node_functions(ObjectKind kind) {
    const auto of = [](const char* name, lua_CFunction pairs) {
        return ObjectFunctions{node_index, node_newindex, pairs, node_tostring, name};
    };
    switch (kind) {
        case ObjectKind::component: return of("component", component_pairs);
        case ObjectKind::ports: return of("ports", node_pairs);
        case ObjectKind::port: return of("port", nullptr);
        case ObjectKind::config: return of("config", node_pairs);
        case ObjectKind::truth: return of("truth", node_pairs);
        default: return of("system", node_pairs);
    }
}

const FoundNode* Objects::find_node(const ObjectRef& ref, std::string_view path) const {
    constexpr std::size_t most = 64;
    RunningSystem* const live = ref.live();
    if (live == nullptr) return nullptr;
    std::vector<FoundNode>& found = core_->found;
    const std::uint64_t layout = std::as_const(*live).system().layout();
    const auto known = std::find_if(found.begin(), found.end(), [&](const FoundNode& each) {
        return each.live == live && each.kind == ref.kind && each.path == path && each.component == ref.component() &&
               each.port == ref.port();
    });
    if (known != found.end() && known->layout == layout) return &*known;
    if (known != found.end()) found.erase(known);
    auto node = node_of(ref);
    std::string_view below = path;
    while (node && !below.empty() && !node->is_value()) node = node->child(take_step(below));
    if (!node || node->kind() == NodeKind::data) return nullptr;
    if (found.size() == most) found.clear();
    found.push_back({live, layout, ref.kind, std::string(ref.component()), std::string(ref.port()), std::string(path),
                     std::move(*node), std::string(below)});
    return &found.back();
}

std::optional<Value> Objects::scalar_at(lua_State* L, int index, std::string_view path) const {
    const ObjectRef* ref = to_object(L, index);
    if (ref == nullptr || !ObjectAccess::is_ready(*this)) return std::nullopt;
    const FoundNode* found = find_node(*ref, path);
    if (found == nullptr) return std::nullopt;
    auto value = found->node.value_at(found->below);
    Value* const held = value ? std::get_if<Value>(&*value) : nullptr;
    if (held == nullptr || !(held->type().is_number() || held->is<bool>())) return std::nullopt;
    if (found->node.port() != nullptr && on_read_) on_read_({ref->live(), found->node.component(), found->node.port()});
    return std::move(*held);
}

std::optional<ComponentAt> Objects::component_of(lua_State* L, int index) const {
    const ObjectRef* ref = to_object(L, index, ObjectKind::component);
    const FoundNode* found = ref != nullptr ? find_node(*ref, "") : nullptr;
    return found != nullptr ? std::optional(ComponentAt{ref->live(), found->node.component()}) : std::nullopt;
}

RunningSystem* Objects::to_system(lua_State* L, int index) {
    const ObjectRef* ref = to_object(L, index, ObjectKind::system);
    return ref != nullptr ? ref->live() : nullptr;
}

}  // namespace nezumi
