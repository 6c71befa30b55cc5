// The region that holds the first small blocks of a Lua state.
#include <catch2/catch.hpp>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "bindings/lua/sandbox/small_blocks.hpp"
#include "tests/unit/lua/sandbox_support.hpp"

using namespace nezumi;

#if !defined(NEZUMI_ADDRESS_SANITIZER)

TEST_CASE("small blocks are adjacent, aligned, and do not overlap", "[lua][memory]") {
    SmallBlocks blocks;
    std::vector<char*> taken;
    std::vector<std::size_t> sizes;
    for (std::size_t size = 1; void* const block = blocks.take(size); size = size % SmallBlocks::most + 1) {
        CHECK(reinterpret_cast<std::uintptr_t>(block) % alignof(void*) == 0);
        CHECK(blocks.owns(block));
        std::memset(block, static_cast<int>(taken.size()), size);
        taken.push_back(static_cast<char*>(block));
        sizes.push_back(size);
    }
    REQUIRE(taken.size() > 100);
    std::size_t bytes = 0;
    for (std::size_t i = 0; i < taken.size(); ++i) {
        CHECK(std::string(taken[i], sizes[i]) == std::string(sizes[i], static_cast<char>(i)));
        CHECK((i == 0 || taken[i] - taken[i - 1] == static_cast<std::ptrdiff_t>((sizes[i - 1] + 7) / 8 * 8)));
        bytes += (sizes[i] + 7) / 8 * 8;
    }
    CHECK(bytes <= SmallBlocks::region);
    CHECK(bytes > SmallBlocks::region - SmallBlocks::most);
}

TEST_CASE("a released block is reused for the same size only", "[lua][memory]") {
    SmallBlocks blocks;
    void* const first = blocks.take(56);
    void* const second = blocks.take(56);
    blocks.give_back(first, 56);
    blocks.give_back(second, 56);
    CHECK(blocks.take(57) != first);
    CHECK(blocks.take(49) == second);  // it needs as many words
    CHECK(blocks.take(56) == first);
    CHECK(blocks.take(56) != second);
}

TEST_CASE("large blocks, and blocks after the region is full, are refused", "[lua][memory]") {
    SmallBlocks blocks, other;
    CHECK_FALSE(blocks.owns(&blocks));
    CHECK_FALSE(blocks.owns(nullptr));
    CHECK(blocks.take(SmallBlocks::most + 1) == nullptr);
    void* last = nullptr;
    while (void* const block = blocks.take(SmallBlocks::most)) last = block;
    CHECK(blocks.take(1) == nullptr);
    CHECK_FALSE(other.owns(last));
    CHECK_FALSE(blocks.owns(static_cast<char*>(last) + SmallBlocks::most));
    blocks.give_back(last, SmallBlocks::most);
    CHECK(blocks.take(SmallBlocks::most) == last);
}

#endif

TEST_CASE("the memory of a state is counted exactly, in and outside of the region", "[lua][memory]") {
    Box box;
    lua_State* const lua = box.lua();
    const auto gather = [&] {
        lua_gc(lua, LUA_GCCOLLECT);
        return box.state->memory();
    };
    const std::size_t before = gather();
    const std::string_view text =
        "local kept = {} for i = 1, 2000 do kept[i] = { i, tostring(i), { x = i } } kept[i - 40] = nil end "
        "local s = '' for i = 1, 300 do s = s .. i end return #s + #kept";
    for (int i = 0; i < 5; ++i) {
        CHECK(box.run(text).substr(0, 1) != "b");
        lua_settop(lua, 0);
        CHECK(static_cast<std::size_t>(lua_gc(lua, LUA_GCCOUNT)) * 1024 +
                  static_cast<std::size_t>(lua_gc(lua, LUA_GCCOUNTB)) ==
              box.state->memory());
    }
    CHECK(gather() < before + 4096);
}
