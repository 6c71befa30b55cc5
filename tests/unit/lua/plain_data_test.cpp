// Plain data keeps its shape between Lua states, and what can't go along is named.
#include "bindings/lua/values/plain_data.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "bindings/lua/sandbox/compile.hpp"
#include "bindings/lua/sandbox/locked_table.hpp"
#include "bindings/lua/sandbox/stdlib.hpp"
#include "bindings/lua/values/set_plain.hpp"
#include "tests/unit/leaf_text.hpp"

using namespace nezumi;

namespace {

// A chunk's own time limit is not what is tested here.
constexpr Budget ample{5.0};

// The values that a chunk returns.
PlainData take(const std::string& text, std::vector<Dropped>* dropped = nullptr) {
    auto state = create_sandbox().value();
    lua_State* L = state->lua();
    REQUIRE(load_chunk(L, compile(text, "test").value()));
    REQUIRE(protected_call(L, 0, LUA_MULTRET, ample));
    const int count = lua_gettop(L);
    std::vector<Dropped> ignored;
    auto data = take_plain(L, count, ample, std::vector<std::string>(static_cast<std::size_t>(count), "v"),
                           dropped != nullptr ? *dropped : ignored);
    CHECK(lua_gettop(L) == count);
    REQUIRE(data);
    return *data;
}

// Gives data to a function in another state, and takes what that returns.
std::string check(const PlainData& data, const std::string& text) {
    auto state = create_sandbox().value();
    lua_State* L = state->lua();
    REQUIRE(load_chunk(L, compile(text, "test").value()));
    REQUIRE(protect(L, ample, [&](lua_State* inside) {
        push_plain(inside, data);
        return lua_gettop(inside);
    }));
    auto ok = protected_call(L, static_cast<int>(data.values.size()), 0, ample);
    return ok ? "" : ok.error().message;
}

void push_numbers(lua_State* L) {
    lua_createtable(L, 3, 0);
    for (int i = 1; i <= 2; ++i) {
        lua_pushinteger(L, i);
        lua_rawseti(L, -2, i);
    }
}

}  // namespace

TEST_CASE("values and tables cross from one Lua state to another", "[lua][plain]") {
    CHECK(check(take("return 1, 2.5, true, 'a\\0b', nil, { x = { 1, 2 }, [2.5] = 'n', [false] = 0 }"),
                "local a, b, c, d, e, t = ... "
                "assert(math.type(a) == 'integer' and b == 2.5 and c == true and d == 'a\\0b' and e == nil) "
                "assert(#t.x == 2 and t[2.5] == 'n' and t[false] == 0)") == "");
}

TEST_CASE("shared and cyclic tables keep their shape, also across values", "[lua][plain]") {
    CHECK(check(take("local s = {} local t = { s, s } t.t = t return t, s"),
                "local t, s = ... assert(t[1] == s and t[2] == s and t.t == t and next(s) == nil)") == "");
}

TEST_CASE("plain data put into a table leaves the tables and the other values that it has", "[lua][plain]") {
    const PlainData data = take(
        "local s = { n = 2 } local t = { n = 1, list = { 7, s, [4] = false, seq = { 6 } }, s = s, other = { 1 }, f = "
        "5, "
        "was_number = {}, seq = { 4, 5 }, locked = { 9 } } t.list.t = t return t");
    auto state = create_sandbox().value();
    lua_State* L = state->lua();
    REQUIRE(load_chunk(L, compile(R"(
local seq, other, locked = ...
local t = { n = 5, gone = 1, gone_too = { 1 }, list = { 1, { n = 0 }, 3 }, f = print, g = print, was_number = 3,
            [print] = 1, seq = seq, locked = locked, gone_locked = locked }
local list, s = t.list, t.list[2]
t.s, t.same = s, s
list.seq = other
return function()
  assert(t.seq == seq and seq[1] == 4 and seq[2] == 5 and rawlen(seq) == 2 and seq.says == 'hidden')
  assert(list.seq == other and other[1] == 6 and rawlen(other) == 1 and other.says == 'hidden')
  assert(t.locked ~= locked and t.locked[1] == 9 and locked[1] == 1 and #locked == 2 and t.gone_locked == nil)
  assert(t.n == 1 and t.gone == nil and t.gone_too == nil and t.same == nil and t.f == print and t.g == print)
  assert(t.list == list and list[1] == 7 and list[2] == s and list[3] == nil and list[4] == false and list.t == t)
  assert(t.s == s and s.n == 2 and t.other[1] == 1 and next(t.was_number) == nil and t[print] == 1)
end, t
)",
                                  "test")
                              .value()));
    REQUIRE(protect(L, {}, [](lua_State* inside) {
        for (int i = 0; i < 2; ++i) {
            push_numbers(inside);
            lua_createtable(inside, 0, 2);  // as that of what a port reads
            lua_createtable(inside, 0, 1);
            lua_pushliteral(inside, "hidden");
            lua_setfield(inside, -2, "says");
            lua_setfield(inside, -2, "__index");
            hide_metatable(inside);
            lua_setmetatable(inside, -2);
        }
        push_numbers(inside);
        lock_table(inside, "gains");
        return 3;
    }));
    REQUIRE(protected_call(L, 3, 2, {}));
    lua_rawsetp(L, LUA_REGISTRYINDEX, &data);
    REQUIRE(protect(L, {}, [&](lua_State* inside) {
        lua_rawgetp(inside, LUA_REGISTRYINDEX, &data);
        set_plain(inside, data);
        return lua_gettop(inside) == 1 ? 0 : luaL_error(inside, "what is on the stack?");
    }));
    const auto ok = protected_call(L, 0, 0, {});
    CHECK((ok ? "" : ok.error().message) == "");
}

TEST_CASE("values that are not plain data are left out and named in a fixed order", "[lua][plain]") {
    std::vector<Dropped> dropped;
    const PlainData data = take(
        "local m = setmetatable({ 7 }, {}) return { z = print, a = { [1] = coroutine.create(print), ['x y'] = print }, "
        "m = m, [{}] = 1 }",
        &dropped);
    CHECK(dropped == std::vector<Dropped>{{"v", "a table with a key that is a table, a function or an object"},
                                          {"v.z", "a function"},
                                          {"v.a[1]", "a coroutine"},
                                          {"v.a[\"x y\"]", "a function"},
                                          {"v.m", "a table with a metatable"}});
    CHECK(check(data, "local t = ... assert(t.z == nil and next(t.a) == nil and t.m[1] == 7)") == "");
}

TEST_CASE("a long list overflows no stack and takes no square of its length", "[lua][plain]") {
    std::vector<Dropped> dropped;
    const PlainData data =
        take("local l = { last = print } for i = 1, 200000 do l = { next = l } end return l", &dropped);
    CHECK(data.tables.size() == 200001);
    REQUIRE(dropped.size() == 1);
    CHECK(dropped[0].path.substr(0, 8) == "....next");
    CHECK(check(data, "local n, l = 0, ... while l do n, l = n + 1, l.next end assert(n == 200001)") == "");
}

TEST_CASE("data that does not fit into the other state's memory is an error", "[lua][plain]") {
    const PlainData data = take("local t = {} for i = 1, 20000 do t[i] = { i } end return t");
    auto state = create_sandbox({.memory_limit = 256 << 10}).value();
    const auto pushed = protect(state->lua(), {}, [&](lua_State* inside) {
        push_plain(inside, data);
        return 1;
    });
    REQUIRE_FALSE(pushed);
    CHECK(pushed.error().message.substr(0, 17) == "not enough memory");
}

TEST_CASE("the leaves of a table are visited by their paths, and a table within itself ends", "[lua][plain]") {
    std::string told;
    visit_plain(take("local t = { 7, { deep = true }, count = 2, ['a b'] = 'x', [-1] = 0.5, [true] = 1 } return t"),
                [&](const LeafPath& path, const ValueView& leaf) {
                    told += fmt::format("{}={} ", path.text(), text_of(leaf));
                });
    CHECK(told == "[-1]=0.5 [1]=7 [2].deep=true a b=x count=2 [true]=1 ");
    int leaves = 0;
    const auto count = [&](const LeafPath&, const ValueView&) { ++leaves; };
    visit_plain(take("local t = { 1 } t.own, t.again = t, t return t"), count);
    CHECK(leaves > 1);
    CHECK(leaves < 5000);
    visit_plain(take("return 3"), count);
    visit_plain(take("return"), count);
}

TEST_CASE("a look takes whole tables as far as its limit goes, the nearest first", "[lua][plain]") {
    auto state = create_sandbox().value();
    lua_State* L = state->lua();
    const auto look = [&](const std::string& text, const PlainLimit& limit) {
        lua_settop(L, 0);
        REQUIRE(load_chunk(L, compile(text, "test").value()));
        REQUIRE(protected_call(L, 0, 1, {}));
        auto seen = snapshot_plain(L, ample, limit);
        CHECK(lua_gettop(L) == 1);
        REQUIRE(seen);
        return *seen;
    };
    const auto check = [](const PlainSnapshot& seen, const std::string& text) -> std::string {
        auto other = create_sandbox().value();
        lua_State* inside = other->lua();
        REQUIRE(load_chunk(inside, compile(text, "test").value()));
        REQUIRE(protect(inside, {}, [&](lua_State* called) {
            push_plain(called, seen);
            return lua_gettop(called);
        }));
        auto ok = protected_call(inside, 1, 0, {});
        return ok ? "" : ok.error().message;
    };
    const std::string table = "return { a = 1, b = { 1, 2, x = { 'y' } }, c = { {}, {}, {}, 4 } }";
    CHECK(look(table, {.values = 11, .text = 5}).whole == 7);
    CHECK(look(table, {.values = 11, .text = 4}).whole == 3);

    const PlainSnapshot part = look(table, {.values = 7, .text = 100});
    CHECK(part.whole == 2);
    CHECK(part.data.tables[2].empty());
    CHECK(check(part, "local t = ... assert(t.a == 1 and t.b[2] == 2) assert(type(t.c) == 'userdata')") == "");
    for (const char* use :
         {"return t.c[4]", "return #t.c", "t.c[1] = 2", "for _ in pairs(t.c) do end", "return t.b.x[1]"})
        CHECK(
            check(part, std::string("local t = ... ") + use)
                .find(
                    "this table was left out, so that no tick is late: at most 4000 values are read at once; a command "
                    "of the script can return a part") != std::string::npos);
    CHECK(check(part, "local t = ... assert(tostring(t.c) == '(left out: too large to show)')") == "");

    const PlainSnapshot none = look(table, {.values = 2, .text = 100});
    CHECK(none.whole == 0);
    CHECK(none.data.tables[0].empty());
    CHECK(look("return { ('x'):rep(101) }", {.values = 10, .text = 100}).whole == 0);
    CHECK(look("return { [('x'):rep(101)] = 1 }", {.values = 10, .text = 100}).whole == 0);
    CHECK(look("return 7", {.values = 0, .text = 0}).whole == 0);
}
