// Plain data on its way between Lua states.
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

/// What could not be taken along: "state.a.b" and "a function".
struct Dropped {
    std::string path;
    std::string what;

    bool operator==(const Dropped&) const = default;
};

/// Takes copies of the topmost `count` values of the stack, which stay. `names` says what each is called in `dropped`,
/// which collects in a fixed order what is no plain data: functions, userdata, coroutines, keys that are tables,
/// metatables (whose table is taken without it). A matrix is taken as the table of its rows. The depth of tables does
/// not matter. An error only when memory or the budget runs out, or when there is more than the limit allows.
Expected<PlainData> take_plain(lua_State* L, int count, Budget budget, const std::vector<std::string>& names,
                               std::vector<Dropped>& dropped, const PlainLimit& limit = no_limit);

/// The same as `take_plain` for the topmost value, which stays. `dropped` may be null; where it is given, a matrix is
/// no plain data either: what is taken is to be put in the place of what was there.
Expected<PlainSnapshot> snapshot_plain(lua_State* L, Budget budget, const PlainLimit& limit,
                                       const std::string& name = "", std::vector<Dropped>* dropped = nullptr);

/// Visits the numbers, truth values and texts in the table that is the first value: "count", "list[2].deep". Tables
/// that lie too deep, as those within themselves, and what is beyond some thousand entries are left out.
void visit_plain(const PlainData& data, const LeafVisitor& visit);

/// Pushes fresh copies of all values. May raise a Lua error: use it within a protected call.
void push_plain(lua_State* L, const PlainData& data);
/// The same; in place of each table that was left out stands an object that says so, to whoever looks into it.
void push_plain(lua_State* L, const PlainSnapshot& snapshot);

}  // namespace nezumi
