// Copies plain data between Lua states.
#pragma once

#include <limits>
#include <lua.hpp>
#include <string>
#include <vector>

#include "bindings/lua/sandbox/call.hpp"
#include "engine/ports/payload.hpp"
#include "engine/values/plain_data.hpp"

namespace nezumi {

inline constexpr PlainLimit no_limit{std::numeric_limits<std::size_t>::max(), std::numeric_limits<std::size_t>::max()};

/// True for the `lua_type` of a boolean, number or text.
inline bool is_scalar(int type) { return type == LUA_TBOOLEAN || type == LUA_TNUMBER || type == LUA_TSTRING; }

/// A value that could not be copied: its path, such as "state.a.b", and its kind, such as "a function".
struct Dropped {
    std::string path;
    std::string what;

    bool operator==(const Dropped&) const = default;
};

/// Copies the topmost `count` values of the stack, which stay there. `dropped` gets what is not plain data, in a fixed
/// order: functions, userdata, coroutines, keys that are tables, and metatables (a table is copied without its
/// metatable). `names` are the names of the copied values in `dropped`. A matrix is copied as the table of its rows.
/// Tables may have any depth. An error only if memory or the budget runs out, or if the limit is exceeded.
Expected<PlainData> take_plain(lua_State* L, int count, Budget budget, const std::vector<std::string>& names,
                               std::vector<Dropped>& dropped, const PlainLimit& limit = no_limit);

/// Does what `take_plain` does for the topmost value, which stays there. `dropped` may be null. If it is not null, a
/// matrix is dropped too, because the copy will replace the original, which would then have a table instead of the
/// matrix.
Expected<PlainSnapshot> snapshot_plain(lua_State* L, Budget budget, const PlainLimit& limit,
                                       const std::string& name = "", std::vector<Dropped>* dropped = nullptr);

/// Visits the numbers, booleans and texts of the first value, which must be a table: "count", "list[2].deep". Tables
/// that are too deep (such as those that contain themselves) are omitted, and all entries after the first 5000.
void visit_plain(const PlainData& data, const LeafVisitor& visit);

/// Pushes fresh copies of all values. May raise a Lua error: use it within a protected call.
void push_plain(lua_State* L, const PlainData& data);
/// Pushes fresh copies. In place of a table that was left out, there is an object that raises an error when a script
/// reads it.
void push_plain(lua_State* L, const PlainSnapshot& snapshot);

}  // namespace nezumi
