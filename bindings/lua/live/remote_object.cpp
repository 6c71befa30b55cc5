// Objects of components on other hosts, such as `hosts.ev3.vehicle`. Their values are requested from the host while
// ticks continue.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include "bindings/lua/live/command_arguments.hpp"
#include "bindings/lua/live/hosts_object.hpp"
#include "bindings/lua/live/object_core.hpp"
#include "bindings/lua/sandbox/ordered.hpp"
#include "bindings/lua/values/codec.hpp"
#include "engine/base/visible.hpp"
#include "engine/live/answer_question.hpp"
#include "engine/tree/member.hpp"

namespace nezumi {
namespace {

using Names = std::vector<std::string>;
using What = Question::What;
using NodeKind = TreeNode::Kind;

// A request about an object, or about its member `name`.
Question question_of(const ObjectRef& ref, What what, std::string_view name = "") {
    return {.host = std::string(host_of(ref.component())),
            .component = std::string(without_host(ref.component())),
            .what = what,
            .name = join_path(std::string(ref.port()), name)};
}

// "ev3/vehicle.config"
std::string full_path(const ObjectRef& ref) { return join_path(std::string(ref.component()), ref.port()); }

Answer object(const ObjectRef& ref, std::string path) {
    return ObjectName{ObjectKind::remote, ref.live(), std::string(ref.component()), std::move(path)};
}

Expected<NodeSnapshot> look_at(const Objects& objects, const ObjectRef& ref, std::string_view name = "") {
    auto answer = ask_host(objects, *ref.live(), question_of(ref, What::look, name));
    return answer ? read_snapshot(std::move(*answer)) : Unexpected(answer.error());
}

// Methods

struct Method {
    std::string_view name;
    What what;
};
constexpr std::array methods{Method{"activate", What::activate}, Method{"deactivate", What::deactivate},
                             Method{"reset", What::reset}, Method{"use", What::use}};

Expected<const ObjectRef*> check_remote_self(lua_State* L, std::string_view method) {
    if (const ObjectRef* self = to_object(L, 1, ObjectKind::remote)) return self;
    return failure(fmt::format("{}: write `X:{}(...)` with a colon, not `X.{}(...)`", method, method, method));
}

int call_method(lua_State* L) {
    Objects& objects = objects_of(L);
    return answer_beside(L, objects, [&]() -> Expected<Answer> {
        const std::string_view name = text_at(L, lua_upvalueindex(2));
        const auto self = check_remote_self(L, name);
        if (!self) return Unexpected(self.error());
        const ObjectRef& ref = **self;
        const auto* method =
            std::find_if(methods.begin(), methods.end(), [&](const Method& each) { return each.name == name; });
        if (!ref.port().empty() || (method == methods.end() && find_member(component_members(), name) != nullptr))
            return failure(fmt::format("{}:{}: this can be done only on its own host", full_path(ref), name));
        Question question = question_of(ref, What::command, name);
        if (method == methods.end()) {
            auto arguments = read_arguments(L, name);
            if (!arguments) return Unexpected(arguments.error());
            question.values = std::move(*arguments);
        } else {
            const bool uses = method->what == What::use;
            if (uses && lua_type(L, 2) != LUA_TSTRING)
                return failure(R"(use: expected the name of a set, as in :use "careful")");
            question.what = method->what;
            question.name = uses ? text_at(L, 2) : "";
        }
        auto results = ask_host(objects, *ref.live(), question);
        return results ? Expected<Answer>(Answer{std::move(*results)}) : Unexpected(results.error());
    });
}

// Members

// Members that need no request: names, the methods of every component, and the ports that the host has announced.
std::optional<Answer> known_member(const ObjectRef& ref, std::string_view name) {
    const bool is_component = ref.port().empty();
    if (is_component && name == "name") return Answer{Value{full_path(ref)}};
    if (is_component && name == "ports") return object(ref, "ports");
    if (!is_component && ref.port() != "ports") return std::nullopt;
    const MemberInfo* member = is_component ? find_member(component_members(), name) : nullptr;
    const bool may_be_port = member == nullptr || member->yields;
    if (may_be_port && check_offered(ref.live()->system(), fmt::format("{}.{}", ref.component(), name)))
        return object(ref, std::string(name));
    if (member != nullptr && member->called) return Answer{MethodName{call_method, std::string(name)}};
    return std::nullopt;
}

int remote_index(lua_State* L) {
    Objects& objects = objects_of(L);
    return look_beside(L, objects, [&]() -> Expected<Answer> {
        const ObjectRef& ref = *to_object(L, 1);
        if (lua_type(L, 2) != LUA_TSTRING)
            return failure(fmt::format("{}: expected the name of a member", full_path(ref)));
        const std::string_view name = text_at(L, 2);
        std::optional<Answer> known;
        auto visited = ObjectAccess::visit(objects, [&]() -> Expected<Answer> {
            known = known_member(ref, name);
            return Answer{};
        });
        if (!visited) return visited;
        if (known) return std::move(*known);
        auto look = look_at(objects, ref, name);
        if (!look) return Unexpected(look.error());
        switch (look->kind) {
            case NodeKind::ports:
            case NodeKind::port:
            case NodeKind::config:
            case NodeKind::truth: return object(ref, join_path(std::string(ref.port()), name));
            case NodeKind::method:
            case NodeKind::command: return Answer{MethodName{call_method, std::string(name)}};
            default: return Answer{std::move(look->value)};
        }
    });
}

int remote_newindex(lua_State* L) {
    Objects& objects = objects_of(L);
    return answer_beside(L, objects, [&]() -> Expected<Answer> {
        const ObjectRef& ref = *to_object(L, 1);
        if (ref.port() != "config")
            return failure(fmt::format("members of {} can't be set; parameters can, as in X.config.NAME = value",
                                       ref.component()));
        if (lua_type(L, 2) != LUA_TSTRING) return failure("config: expected the name of a parameter");
        Question question = question_of(ref, What::set);
        question.name = text_at(L, 2);
        auto value = read_parameter(L, 3);
        if (!value) return failure(fmt::format("parameter '{}': {}", shown(question.name), value.error().message));
        question.values.values.push_back(std::move(*value));
        const auto done = ask_host(objects, *ref.live(), question);
        return done ? Expected<Answer>(Answer{}) : Unexpected(done.error());
    });
}

int remote_pairs(lua_State* L) {
    const ObjectRef& ref = *to_object(L, 1);
    if (ref.port() == "ports")
        return pairs_of_names(L, [](const ObjectRef& ports) -> Expected<Names> {
            Names names;
            for (const OfferedPort& port : ports_of(ports.live()->system(), ports.component()))
                names.push_back(port.name);
            return names;
        });
    Objects& objects = objects_of(L);
    lua_settop(L, 1);
    lua_pushnil(L);  // no key: the value is the whole object
    look_beside(L, objects, [&]() -> Expected<Answer> {
        if (ref.port().empty()) return failure("a component can't be traversed; its parameters can: pairs(X.config)");
        auto look = look_at(objects, ref);
        if (!look) return Unexpected(look.error());
        return Answer{std::move(look->value)};
    });
    lua_pushcfunction(L, ordered_pairs);
    lua_pushvalue(L, 3);
    lua_call(L, 1, 3);
    return 3;
}

int remote_tostring(lua_State* L) {
    Objects& objects = objects_of(L);
    return answer_beside(L, objects, [&]() -> Expected<Answer> {
        const ObjectRef& ref = *to_object(L, 1);
        const auto text = text_of_host(objects, ref, What::show);
        if (!text) return Answer{Value{fmt::format("{}: {}", full_path(ref), text.error().message)}};
        // The text about a component or a port begins with its name: the name of the host is put before it.
        const bool is_named = ref.port() != "config" && ref.port() != "ports" && ref.port() != "truth";
        return Answer{Value{is_named ? fmt::format("{}/{}", host_of(ref.component()), *text) : *text}};
    });
}

}  // namespace

Expected<std::string> text_of_host(const Objects& objects, const ObjectRef& ref, Question::What what) {
    const auto answer = ask_host(objects, *ref.live(), question_of(ref, what));
    if (!answer) return Unexpected(answer.error());
    const auto* text = answer->values.size() == 1 ? answer->values[0].get_if<std::string>() : nullptr;
    return text != nullptr ? Expected<std::string>(visible(*text)) : failure("malformed answer: expected a text");
}

Expected<PlainData> ask_host(const Objects& objects, const RunningSystem& live, const Question& question) {
    std::optional<std::uint64_t> number;
    std::optional<Expected<PlainData>> got;
    int start = 0;
    const auto turn = [&]() -> Expected<Answer> {
        const Network* network = live.system().network();
        if (network == nullptr) return Unexpected(find_host(live.system(), question.host).error());
        if (number && start != live.generation()) return failure("the system was restarted before the answer came");
        if (number) {
            got = network->answer(*number);
            return Answer{};
        }
        const auto asked = network->ask(question);
        if (!asked) return Unexpected(asked.error());
        number = *asked;
        start = live.generation();
        return Answer{};
    };
    while (!got) {
        if (auto done = ObjectAccess::visit(objects, turn); !done) return Unexpected(done.error());
        if (got) break;
        if (!ObjectAccess::ticks_beside(objects))
            return failure("other hosts can't be asked here: no ticks pass, so no answer can come");
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return std::move(*got);
}

std::optional<std::string> port_of_host(lua_State* L, int index) {
    if (lua_type(L, index) == LUA_TSTRING && is_remote(text_at(L, index))) return std::string(text_at(L, index));
    const ObjectRef* ref = to_object(L, index, ObjectKind::remote);
    return ref != nullptr && !ref->port().empty() ? std::make_optional(full_path(*ref)) : std::nullopt;
}

std::optional<std::string> path_of_host(lua_State* L, int index, std::string_view path) {
    const ObjectRef* ref = to_object(L, index);
    if (ref == nullptr || ref->kind < ObjectKind::hosts) return std::nullopt;
    std::string whole = ref->kind == ObjectKind::remote ? full_path(*ref) : std::string(ref->component());
    std::string_view rest = path.substr(path.starts_with('.') ? 1 : 0);
    if (whole.empty()) whole = take_step(rest);
    if (!is_remote(whole)) return fmt::format("{}/{}", whole, rest);
    return join_path(std::move(whole), rest);
}

const ObjectFunctions& remote_functions() {
    static constexpr ObjectFunctions functions{remote_index, remote_newindex, remote_pairs, remote_tostring,
                                               "component of another host"};
    return functions;
}

}  // namespace nezumi
