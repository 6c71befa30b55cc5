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

TEST_CASE("garbage collection during a traversal does no harm", "[lua][order]") {
    StateOptions options;
    options.memory_limit = 2 << 20;
    Box box(options);
    CHECK(traverse(box,
                   "local t = {} for i = 1, 200 do t[('long key '):rep(10) .. i] = i t['s' .. i] = i end local n = 0 "
                   "for k, v in each(t) do t[k] = nil local junk = {} for i = 1, 100 do junk[i] = { k } end n = n + v "
                   "end return n") == "40200");
}

}  // namespace
}  // namespace nezumi
