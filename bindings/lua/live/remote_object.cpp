// A component of another host, `hosts.ev3.vehicle`: it is asked over the network while ticks go on.
#include <fmt/format.h>

#include <algorithm>
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
#include "engine/tree/member.hpp"
#include "engine/values/value_text.hpp"

namespace nezumi {
namespace {

using Names = std::vector<std::string>;
using What = Question::What;

// Asks, and waits for the answer beside the ticks: as long as the network does.
Expected<PlainData> ask(const Objects& objects, const ObjectRef& ref, What what, std::string_view name = "",
                        PlainData values = {}) {
    const Question question{.host = std::string(host_of(ref.component())),
                            .component = std::string(without_host(ref.component())),
                            .what = what,
                            .name = std::string(name),
                            .values = std::move(values)};
    std::optional<std::uint64_t> number;
    std::optional<Expected<PlainData>> got;
    int start = 0;
    const auto turn = [&]() -> Expected<Answer> {
        const RunningSystem& live = *ref.live();
        const Network* network = live.system().network();
        if (network == nullptr) return Unexpected(find_host(live.system(), question.host).error());
        if (number && start != live.starts()) return failure("the system began anew meanwhile");
        if (number) {
            got = network->answer(*number);
            return Answer{};
        }
        const auto asked = network->ask(question);
        if (!asked) return Unexpected(asked.error());
        number = *asked;
        start = live.starts();
        return Answer{};
    };
    while (!got) {
        if (auto done = ObjectAccess::visit(objects, turn); !done) return Unexpected(done.error());
        if (got) break;
        if (!ObjectAccess::ticks_beside(objects)) return failure("no answer can come: nothing ticks beside");
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return std::move(*got);
}

// The entries of a table of a look, which came from elsewhere: none where it is not there.
const PlainData::Table& entries_of(const PlainData& look, const TableRef& table) {
    static const PlainData::Table none;
    return table.index < look.tables.size() ? look.tables[table.index] : none;
}

// What a look says of this; nullptr for nothing.
const Value* find(const PlainData& look, std::string_view key) { return find_entry(entries_of(look, {}), key); }

// The table of parameters in a look.
TableRef config_of(const PlainData& look) {
    const Value* value = find(look, "config");
    const auto* ref = value != nullptr ? value->get_if<TableRef>() : nullptr;
    return ref != nullptr ? *ref : TableRef{look.tables.size()};
}

// One value of a look, whose tables go with it.
Answer answer_of_value(PlainData look, Value value) {
    look.values = {std::move(value)};
    const std::size_t whole = look.tables.size();
    return Answer{PlainSnapshot{std::move(look), whole}};
}

Names keys_of(const PlainData::Table& table) {
    Names names;
    for (const auto& [key, value] : table) {
        if (const auto* text = key.get_if<std::string>()) names.push_back(*text);
    }
    return names;
}

std::string config_text(const PlainData& look) {
    Names lines;
    for (const auto& [key, value] : entries_of(look, config_of(look))) {
        if (const auto* name = key.get_if<std::string>())
            lines.push_back(fmt::format("{} = {}", shown(*name), visible(short_text(value))));
    }
    return fmt::format("{}", fmt::join(lines, "\n"));
}

// Methods

const RemoteMethod* find_method(std::string_view name) {
    const auto found = std::find_if(remote_methods.begin(), remote_methods.end(),
                                    [&](const RemoteMethod& each) { return each.name == name; });
    return found != remote_methods.end() ? &*found : nullptr;
}

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
        const RemoteMethod* method = find_method(name);
        if (method == nullptr) {
            auto arguments = read_arguments(L, name);
            if (!arguments) return Unexpected(arguments.error());
            auto results = ask(objects, **self, What::command, name, std::move(*arguments));
            return results ? Expected<Answer>(Answer{std::move(*results)}) : Unexpected(results.error());
        }
        const bool uses = method->what == What::use;
        if (uses && lua_type(L, 2) != LUA_TSTRING)
            return failure(R"(use: expected the name of a set, as in :use "careful")");
        auto done = ask(objects, **self, method->what, uses ? text_at(L, 2) : "");
        return done ? Expected<Answer>(Answer{std::move(*done)}) : Unexpected(done.error());
    });
}

// A component

// What needs no question, or nothing.
std::optional<Expected<Answer>> known_member(const ObjectRef& ref, std::string_view name) {
    const std::string path(ref.component());
    const System& system = ref.live()->system();
    if (name == "name") return Answer{path};
    if (name == "config") return Answer{ObjectName{ObjectKind::remote_config, ref.live(), path, ""}};
    const std::vector<OfferedPort> ports = ports_of(system, path);
    if (name == "ports") {
        Names names;
        for (const OfferedPort& port : ports) names.push_back(port.name);
        return Answer{std::move(names)};
    }
    if (std::find(remote_members.begin(), remote_members.end(), name) != remote_members.end()) return std::nullopt;
    for (const OfferedPort& port : ports) {
        if (port.name == name) return Answer{fmt::format("{}.{}", path, name)};
    }
    if (find_member(component_members(), name) != nullptr && find_method(name) == nullptr)
        return failure(fmt::format("{} has no '{}' over the network", path, name));
    return Answer{MethodName{call_method, std::string(name)}};  // a command, if that host has it
}

int remote_index(lua_State* L) {
    Objects& objects = objects_of(L);
    return look_beside(L, objects, [&]() -> Expected<Answer> {
        const ObjectRef& ref = *to_object(L, 1);
        if (lua_type(L, 2) != LUA_TSTRING)
            return failure(fmt::format("{} is a component: its members have names", ref.component()));
        const std::string_view name = text_at(L, 2);
        std::optional<Expected<Answer>> known;
        auto visited = ObjectAccess::visit(objects, [&]() -> Expected<Answer> {
            known = known_member(ref, name);
            return Answer{};
        });
        if (!visited) return visited;
        if (known) return std::move(*known);
        auto snapshot = ask(objects, ref, What::look);
        if (!snapshot) return Unexpected(snapshot.error());
        const Value* value = find(*snapshot, name);
        return value != nullptr ? answer_of_value(*snapshot, *value) : Answer{};
    });
}

int remote_newindex(lua_State* L) {
    return answer(L, objects_of(L), [&]() -> Expected<Answer> {
        return failure(fmt::format("what is of {} can't be set; parameters can, as in X.config.NAME = value",
                                   to_object(L, 1)->component()));
    });
}

int remote_pairs(lua_State* L) {
    return answer(L, objects_of(L), []() -> Expected<Answer> {
        return failure("a component can't be traversed; its parameters can: pairs(X.config)");
    });
}

int remote_tostring(lua_State* L) {
    Objects& objects = objects_of(L);
    return answer_beside(L, objects, [&]() -> Expected<Answer> {
        const ObjectRef& ref = *to_object(L, 1);
        const auto snapshot = ask(objects, ref, What::look);
        if (!snapshot) return Answer{fmt::format("{}: {}", ref.component(), snapshot.error().message)};
        const auto text = [&](std::string_view key) {
            const Value* value = find(*snapshot, key);
            const auto* is = value != nullptr ? value->get_if<std::string>() : nullptr;
            return is != nullptr ? visible(*is) : "?";
        };
        std::string all = fmt::format("{}  {}, {}", ref.component(), text("type"), text("status"));
        if (find(*snapshot, "error") != nullptr) all += "\nerror: " + text("error");
        auto listed = ObjectAccess::visit(objects, [&]() -> Expected<Answer> {
            for (const OfferedPort& port : ports_of(ref.live()->system(), ref.component()))
                all += fmt::format("\n  {:<3} {}  {}", port.direction == Direction::in ? "in" : "out", port.name,
                                   port.type);
            return Answer{};
        });
        if (!listed) return listed;
        const std::string config = config_text(*snapshot);
        if (!config.empty()) all += "\n" + config;
        return Answer{std::move(all)};
    });
}

// Its parameters

int remote_config_index(lua_State* L) {
    Objects& objects = objects_of(L);
    return look_beside(L, objects, [&]() -> Expected<Answer> {
        const ObjectRef& ref = *to_object(L, 1);
        if (lua_type(L, 2) != LUA_TSTRING) return failure("config: what is in it has a name");
        auto snapshot = ask(objects, ref, What::look);
        if (!snapshot) return Unexpected(snapshot.error());
        const PlainData::Table& config = entries_of(*snapshot, config_of(*snapshot));
        const Value* value = find_entry(config, text_at(L, 2));
        if (value == nullptr) {
            const Names known = keys_of(config);
            return failure(fmt::format("{}: unknown parameter '{}'{}", ref.component(), shown(text_at(L, 2)),
                                       did_you_mean(text_at(L, 2), {known.begin(), known.end()})));
        }
        return answer_of_value(*snapshot, *value);
    });
}

int remote_config_newindex(lua_State* L) {
    Objects& objects = objects_of(L);
    return answer_beside(L, objects, [&]() -> Expected<Answer> {
        const ObjectRef& ref = *to_object(L, 1);
        if (lua_type(L, 2) != LUA_TSTRING) return failure("config: what is in it has a name");
        const std::string name(text_at(L, 2));
        auto value = read_parameter(L, 3);
        if (!value) return failure(fmt::format("parameter '{}': {}", shown(name), value.error().message));
        const auto done = ask(objects, ref, What::set, name, PlainData{.values = {std::move(*value)}, .tables = {}});
        return done ? Expected<Answer>(Answer{}) : Unexpected(done.error());
    });
}

int remote_config_pairs(lua_State* L) {
    Objects& objects = objects_of(L);
    lua_settop(L, 1);
    lua_pushnil(L);  // it is all of the object
    look_beside(L, objects, [&]() -> Expected<Answer> {
        auto snapshot = ask(objects, *to_object(L, 1), What::look);
        if (!snapshot) return Unexpected(snapshot.error());
        const TableRef config = config_of(*snapshot);
        return answer_of_value(std::move(*snapshot), config);
    });
    lua_pushcfunction(L, ordered_pairs);
    lua_pushvalue(L, 3);
    lua_call(L, 1, 3);
    return 3;
}

int remote_config_tostring(lua_State* L) {
    Objects& objects = objects_of(L);
    return answer_beside(L, objects, [&]() -> Expected<Answer> {
        const auto snapshot = ask(objects, *to_object(L, 1), What::look);
        return Answer{snapshot ? config_text(*snapshot) : snapshot.error().message};
    });
}

}  // namespace

const ObjectFunctions& remote_functions() {
    static constexpr ObjectFunctions functions{remote_index, remote_newindex, remote_pairs, remote_tostring,
                                               "component of another host"};
    return functions;
}

const ObjectFunctions& remote_config_functions() {
    static constexpr ObjectFunctions functions{remote_config_index, remote_config_newindex, remote_config_pairs,
                                               remote_config_tostring, "config"};
    return functions;
}

}  // namespace nezumi
