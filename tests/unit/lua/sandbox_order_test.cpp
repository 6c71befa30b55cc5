// The order of pairs and next: the same in every run, and traversal that survives what Lua's own survives.
#include <catch2/catch.hpp>

#include "sandbox_support.hpp"

namespace nezumi {
namespace {

// Both ways to traverse a table; `each` stands for one of them.
std::string traverse(Box& box, const std::string& text) {
    const std::string by_pairs = box.run("local each = pairs " + text, Budget{2.0});
    const std::string by_next = box.run("local each = function(t) return next, t, nil end " + text, Budget{2.0});
    CHECK(by_next == by_pairs);
    return by_pairs;
}

const std::string list_keys =
    " local out = {} for k in each(t) do out[#out + 1] = tostring(k) end return table.concat(out, ' ')";

TEST_CASE("pairs and next visit 1..n, other numbers, strings, false, true", "[lua][order]") {
    Box box;
    CHECK(traverse(box,
                   "local t = { x = 1, a = 2, [true] = 3, [false] = 4, 10, 20, 30, [-1] = 5, [2.5] = 6, [100] = 7, [0] "
                   "= 8, [1e300] = 9, "
                   "[-math.huge] = 1, [math.huge] = 1, [math.mininteger] = 1, [math.maxinteger] = 1, [''] = 1, aa = 1, "
                   "A = 1, ['a-b'] = 1 }" +
                       list_keys) ==
          "1 2 3 -inf -9223372036854775808 -1 0 2.5 100 9223372036854775807 1e+300 inf  A a a-b aa x false true");
    CHECK(traverse(box, "local t = { 1, 2, nil, 4, 5 }" + list_keys) == "1 2 4 5");
    CHECK(traverse(box, "local t = { [2] = 1, [3] = 1, [2.5] = 1 }" + list_keys) == "2 2.5 3");
    CHECK(traverse(box, "local t = { [5] = 1, [6] = 1, [5.5] = 1, [-2] = 1 }" + list_keys) == "-2 5 5.5 6");
    CHECK(traverse(box, "local t = { 1, 1, 1, [-2] = 1, [1.5] = 1, [7] = 1, [0] = 1 }" + list_keys) ==
          "1 2 3 -2 0 1.5 7");
    CHECK(traverse(box,
                   "local t = { [2^53] = 1, [2^53 + 1] = 1, [math.maxinteger] = 1, [2^63] = 1, [0.5] = 1, [-0.5] = 1, "
                   "[0] = 1, [-1] = 1, [-1.5] = 1 }" +
                       list_keys) == "-1.5 -1 -0.5 0 0.5 9007199254740992 9223372036854775807 9.2233720368548e+18");
    CHECK(traverse(box, "local t = {}" + list_keys) == "");
    CHECK(traverse(box, "local t = { 1 }" + list_keys) == "1");
}

TEST_CASE("the order does not depend on how a table came about", "[lua][order]") {
    Box box;
    CHECK(traverse(box,
                   "local t = {} for i = 1, 300 do t['k' .. i] = i t[i * 3] = i t[-i] = i t[i + 0.5] = i end for i = "
                   "1, 300, 2 do t['k' .. i] = nil end "
                   "local last for k in each(t) do if type(last) == type(k) then assert(last < k) end last = k end "
                   "local n = 0 for k, v in each(t) do assert(t[k] == v) n = n + 1 end return n") == "1050");
}

TEST_CASE("fields may be cleared and assigned during a traversal", "[lua][order]") {
    Box box;
    const std::string mixed =
        "local t = { 1, 2, 3, 4, a = 1, b = 2, [-3] = 1, [9] = 1, [2.5] = 1, [true] = 1 } local n = 0 ";
    CHECK(traverse(box, mixed + "for k in each(t) do t[k] = nil n = n + 1 end return n, rawlen(t), next(t)") ==
          "10 0 nil");
    CHECK(traverse(box, mixed + "for k, v in each(t) do t[k] = v + 1 n = n + v end return n, t[1], t.a") == "17 2 2");
    CHECK(
        traverse(
            box,
            mixed +
                "for k in each(t) do n = n + 1 for j in pairs(t) do if j ~= k then t[j] = nil end end end return n") ==
        "1");
    CHECK(traverse(box,
                   "local t = { 1, 2, 3, 4, 5, 6 } local out = '' for k, v in each(t) do out = out .. v if v % 2 == 0 "
                   "then t[k] = nil end end return out") == "123456");
    CHECK(traverse(
              box,
              "local t = { 1, 2, 3, 4 } local out = '' for k in each(t) do out = out .. k t[2] = nil end return out") ==
          "134");
    CHECK(traverse(box,
                   "local t = { [5] = 1, [6] = 1, [5.5] = 1, [7] = 1 } local out = '' for k in each(t) do out = out .. "
                   "k .. ' ' t[k] = nil end return out") == "5 5.5 6 7 ");
}

TEST_CASE("a table may be traversed within its own traversal", "[lua][order]") {
    Box box;
    CHECK(traverse(box,
                   "local t = { 1, 2, a = 1, b = 1, [-1] = 1, [3.5] = 1 } local n = 0 for k in each(t) do for j in "
                   "each(t) do n = n + 1 end end return n") == "36");
    CHECK(traverse(box,
                   "local t = { 1, 2, a = 1, b = 1 } local n = 0 for k in each(t) do for j in each(t) do n = n + 1 "
                   "break end end return n") == "4");
    CHECK(traverse(box,
                   "local t, u = { a = 1, b = 1, c = 1 }, { x = 1, y = 1 } local out = '' for k in each(t) do for j in "
                   "each(u) do out = out .. k .. j .. ' ' end end "
                   "return out") == "ax ay bx by cx cy ");
    CHECK(box.run("local t = { 1, 2, a = 1 } local f, s = pairs(t) local n = 0 for k in f, s do n = n + 1 end for k in "
                  "f, s do n = n + 1 end return n, s == t") == "6 true");
}

TEST_CASE("next goes on from any key", "[lua][order]") {
    Box box;
    CHECK(box.run("local t = { 10, 20, x = 1, y = 2, [-5] = 3 } return next(t), next(t, 1), next(t, 2), next(t, -5), "
                  "next(t, 'x'), next(t, 'y'), next(t, 'w')") == "1 2 -5 x y nil x 1");
    CHECK(box.run("return next({}), next({}, 1), next({}, 'x'), next({ a = 1 }), next({ b = 1, a = 2 })") ==
          "nil nil nil a a 2");
    CHECK(box.run("local t = { b = 1, a = 2 } local n = 0 while next(t) do t[next(t)] = nil n = n + 1 end return n") ==
          "2");
    CHECK(box.run("return next(1)") == "box.lua:1: bad argument #1 to 'next' (table expected, got number)");
    CHECK(box.run("return next(string)") == "byte function");
    CHECK(box.run("local t = { [2] = 1, [2.5] = 1, [3] = 1 } local u = { [4] = 1 } local a = next(t) next(u) return a, "
                  "next(t, a)") == "2 2.5 1");
}

TEST_CASE("a key without an order is an error that says so", "[lua][order]") {
    Box box;
    for (const char* way : {"for k in pairs(t) do end", "for k in next, t do end", "next(t)"}) {
        CHECK(box.run(std::string("local t = { [{}] = 1 } ") + way) ==
              "box.lua:1: a table with a table or function as a key can't be traversed: use numbers, strings or "
              "booleans as keys");
        CHECK(box.run(std::string("local t = { a = 1, [print] = 1 } ") + way) ==
              "box.lua:1: a table with a table or function as a key can't be traversed: use numbers, strings or "
              "booleans as keys");
        CHECK(box.run(std::string("local t = { a = 1, [coroutine.create(print)] = 1 } ") + way) ==
              "box.lua:1: a table with a table or function as a key can't be traversed: use numbers, strings or "
              "booleans as keys");
    }
    CHECK(box.run("local t = { [{}] = 1 } return t[1], #t, select('#', table.unpack(t))") == "nil 0 0");
}

TEST_CASE("pairs honours __pairs, and takes tables only", "[lua][order]") {
    Box box;
    CHECK(box.run("local t = setmetatable({}, { __pairs = function(t) return function(_, k) if not k then return 1, "
                  "'one' end end, t, nil end }) "
                  "for k, v in pairs(t) do return k, v end") == "1 one");
    CHECK(box.run("local c = coroutine.wrap(function() for k in pairs(setmetatable({}, { __pairs = function() "
                  "coroutine.yield('inside') return next, {} end })) do end "
                  "return 'done' end) return c(), c()") == "inside done");
    CHECK(box.run("pairs(nil)") == "box.lua:1: bad argument #1 to 'pairs' (table expected, got nil)");
    CHECK(box.run("pairs()") == "box.lua:1: bad argument #1 to 'pairs' (table expected, got no value)");
    CHECK(box.run("local t = setmetatable({ 1 }, { __index = { 1, 2, x = 1 } }) local n = 0 for k in pairs(t) do n = n "
                  "+ 1 end return n") == "1");
    CHECK(box.run("local t = setmetatable({ 1 }, { __index = function(t, i) if i < 4 then return i end end }) local n "
                  "= 0 for k in ipairs(t) do n = n + 1 end return n") == "3");
}

TEST_CASE("two states give the same order for the same keys", "[lua][order]") {
    const char* const text =
        "local t = {} for i = 1, 1000 do t[('%x'):format(i * 2654435761 % 2^32 // 1 | 0)] = i end for i = 1, 1000, 3 "
        "do t[('%x'):format(i * 2654435761 % 2^32 // 1 | 0)] = nil end "
        "local out = {} for k, v in pairs(t) do out[#out + 1] = k .. v end return table.concat(out)";
    Box a;
    Box b;
    CHECK(a.run(text, Budget{2.0}) == b.run(text, Budget{2.0}));
    CHECK(a.run(text, Budget{2.0}).size() > 5000);
}

TEST_CASE("collections in the middle of a traversal do no harm", "[lua][order]") {
    StateOptions options;
    options.memory_limit = 2 << 20;
    Box box(options);
    CHECK(traverse(box,
                   "local t = {} for i = 1, 200 do t[('long key '):rep(10) .. i] = i t['s' .. i] = i end local n = 0 "
                   "for k, v in each(t) do t[k] = nil local junk = {} for i = 1, 100 do junk[i] = { k } end n = n + v "
                   "end return n") == "40200");
}

TEST_CASE("a sparse table is traversed in time", "[lua][order]") {
    Box box;
    CHECK(traverse(box,
                   "local t = {} for i = 1, 20000 do t[i * 2] = i t['k' .. i] = i end local n = 0 for k in each(t) do "
                   "n = n + 1 end return n") == "40000");
}

}  // namespace
}  // namespace nezumi
