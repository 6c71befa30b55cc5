// Checks and copies the value of a probe while the script runs. Readers get the copy.
#include "bindings/lua/script/probes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bindings/lua/sandbox/locked_table.hpp"
#include "bindings/lua/sandbox/text.hpp"
#include "bindings/lua/script/script_call.hpp"
#include "bindings/lua/values/bridge.hpp"
#include "bindings/lua/values/plain_data.hpp"
#include "engine/base/names.hpp"

namespace nezumi {
namespace {

constexpr std::string_view expected = "expected a number, a boolean, a string or a flat table of them";

// Returns an error unless the table at `index` is flat and small. Raises no Lua error, and leaves the stack unchanged.
Expected<void> check_flat(lua_State* L, int index) {
    const int top = lua_gettop(L);
    const int table = push_behind_lock(L, index) ? lua_gettop(L) : index;
    std::size_t entries = 0;
    bool flat = true;
    for (lua_pushnil(L); entries <= Probes::most_entries && flat && lua_next(L, table) != 0; lua_pop(L, 1)) {
        ++entries;
        flat = is_scalar(lua_type(L, -2)) && is_scalar(lua_type(L, -1));
    }
    lua_settop(L, top);
    if (!flat) return failure(fmt::format("{}, got a table that contains other values", expected));
    if (entries > Probes::most_entries)
        return failure(fmt::format("a table can have at most {} entries", Probes::most_entries));
    return {};
}

// A copy of the value at index 2, the top of the stack.
Expected<PlainData> read_probe(lua_State* L, Budget budget) {
    const int type = lua_type(L, 2);
    if (type == LUA_TTABLE) {
        if (auto ok = check_flat(L, 2); !ok) return Unexpected(ok.error());
    } else if (!is_scalar(type)) {
        return failure(fmt::format("{}, got {}", expected, Arguments{L}.kind(2)));
    }
    if (type == LUA_TSTRING && string_at(L, 2).size() > Probes::most_text)
        return failure(fmt::format("its strings can have at most {} bytes in all", Probes::most_text));
    std::vector<Dropped> dropped;
    auto value = take_plain(L, 1, budget, {"value"}, dropped);
    if (!value) return value;
    if (text_bytes(*value) > Probes::most_text)
        return failure(fmt::format("its strings can have at most {} bytes in all", Probes::most_text));
    return value;
}

// probe(name, value)
int global_probe(lua_State* L) {
    Script& script = script_of(L);
    return bridge(L, [&]() -> Expected<void> {
        if (auto ok = Arguments{L}.at_most("probe", 2, "(name, value)"); !ok) return ok;
        if (lua_type(L, 1) != LUA_TSTRING)
            return failure(fmt::format("probe expected a name, got {}", Arguments{L}.kind(1)));
        const std::string_view name = string_at(L, 1);
        if (script.phase() == Script::Phase::loading)
            return failure(fmt::format("probe '{}': probe can't be called while the file loads", shown(name)));
        lua_settop(L, 2);
        auto value = read_probe(L, script.context().budget);
        if (!value) return failure(fmt::format("probe '{}': {}", shown(name), value.error().message));
        return script.probes().set(name, std::move(*value), script.seconds());
    });
}

}  // namespace

Expected<void> Probes::set(std::string_view name, PlainData value, double seconds) {
    const auto found =
        std::find_if(probes_.begin(), probes_.end(), [&](const Probe& probe) { return probe.name == name; });
    if (found != probes_.end()) {
        found->value = std::move(value);
        found->tm = seconds;
        return {};
    }
    if (!is_identifier(name) || name.size() > longest_name)
        return failure(
            fmt::format("probe '{}': the name is not an identifier: use letters, digits and _, no digit first, "
                        "at most {} of them",
                        shown(name.substr(0, longest_name)), longest_name));
    if (probes_.size() >= most)
        return failure(fmt::format("probe '{}': a component can have at most {} probes", name, most));
    probes_.push_back({std::string(name), std::move(value), seconds});
    return {};
}

void set_probe_global(lua_State* L, Script& script) {
    // Raw access, because the metatable of the globals refuses new globals.
    lua_pushliteral(L, "probe");
    lua_pushlightuserdata(L, &script);
    lua_pushcclosure(L, global_probe, 1);
    lua_rawset(L, -3);
}

}  // namespace nezumi
