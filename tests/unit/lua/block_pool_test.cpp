// The memory of a Lua state: its small blocks, and the libraries that it holds.
#include <algorithm>
#include <cstring>
#include <random>

#include "bindings/lua/sandbox/block_pool.hpp"
#include "bindings/lua/sandbox/state.hpp"
#include "tests/unit/lua/rig.hpp"

using namespace nezumi;

namespace {

struct Block {
    unsigned char* at;
    std::size_t bytes;
    unsigned char mark;
    bool is_whole() const {
        return std::all_of(at, at + bytes, [this](unsigned char byte) { return byte == mark; });
    }
};

}  // namespace

TEST_CASE("blocks of a pool lie apart and keep what is in them, whatever is taken and given back", "[lua][pool]") {
    BlockPool pool;
    std::mt19937 random(1);
    std::vector<Block> blocks;
    int refused = 0;
    for (int i = 0; i < 100'000; ++i) {
        const bool few = blocks.size() < random() % 200;
        if (few) {
            const std::size_t most = random() % 20 == 0 ? BlockPool::largest : 100, bytes = 1 + random() % most;
            auto* at = static_cast<unsigned char*>(pool.take(bytes));
            if (at == nullptr) {
                ++refused;
                continue;
            }
            REQUIRE(pool.owns(at));
            REQUIRE(reinterpret_cast<std::uintptr_t>(at) % alignof(std::max_align_t) == 0);
            blocks.push_back({at, bytes, static_cast<unsigned char>(i)});
            std::memset(at, blocks.back().mark, bytes);
        } else if (!blocks.empty()) {
            std::swap(blocks[random() % blocks.size()], blocks.back());
            REQUIRE(blocks.back().is_whole());
            pool.give_back(blocks.back().at, blocks.back().bytes);
            blocks.pop_back();
        }
    }
    CHECK(refused < 5000);
    CHECK(pool.used() <= BlockPool::region_size);
}

TEST_CASE("a pool gives what was freed again, whole or in parts, before it reaches farther", "[lua][pool]") {
    BlockPool pool;
    void* const large = pool.take(1000);
    void* const other = pool.take(1000);
    const std::size_t used = pool.used();
    pool.give_back(large, 1000);
    CHECK(pool.take(1000) == large);
    pool.give_back(large, 1000);
    pool.give_back(other, 1000);
    for (int i = 0; i < 20; ++i) CHECK(pool.owns(pool.take(100)));
    CHECK(pool.used() >= used);
    CHECK(pool.used() < used + 500);
    CHECK(pool.take(BlockPool::largest + 1) == nullptr);
    CHECK_FALSE(pool.owns(&pool));
}

TEST_CASE("a state that outgrows its pool goes on beside it, and its limit is exact as ever", "[lua][pool]") {
    ScriptRig rig(R"(
        local all = {}
        function on_execute()
          for i = 1, 10000 do all[i] = { i, ("text %d"):format(i) } end
          for i, each in ipairs(all) do assert(each[1] == i and each[2] == "text " .. i) end
          for i = 1, 10000, 2 do all[i] = nil end
        end
        command("keep", function() local kept = {} for i = 1, 1e7 do kept[i] = { i } end end)
    )",
                  {.memory_limit = std::size_t{4} << 20});
    rig.activate().tick(3);
    CHECK(rig.status() == "ACTIVE");
    CHECK(rig.component->script().memory() > 4 * BlockPool::region_size);
    const auto failed = rig.component->call_command("keep", {}, rig.now);
    REQUIRE_FALSE(failed);
    CHECK(failed.error().message == "not enough memory: the script reached its limit of 4 MB");
    CHECK(rig.component->script().memory() < std::size_t{4} << 20);
}

TEST_CASE("libraries come into a script when it names them, and are what they always are", "[lua][pool]") {
    const std::string named = R"(
        local text = output("text", "TimedString")
        function on_execute()
          local _, floor = pcall(math.floor, {})
          local _, upper = pcall(string.upper)
          local _, insert = pcall(table.insert, 1, 2)
          text:write(("%s|%s|%s|%s|%s|%s"):format(floor, upper, insert, ("x"):upper(), "10" + 1, utf8.char(65)))
          assert(math == math and coroutine.isyieldable() == false and ("x").nothing == nil and string.len("ab") == 2)
          assert(not pcall(function() math.pi = 3 end) and #"ab" == ("ab"):len())
        end
    )";
    ScriptRig rig(named);
    rig.activate().tick();
    CHECK(rig.error() == "");
    CHECK(rig.out<std::string>("text").read() ==
          "bad argument #1 to 'math.floor' (number expected, got table)|bad argument #1 to 'string.upper' (string "
          "expected, got no value)|bad argument #1 to 'table.insert' (table expected, got number)|X|11|A");
    const ScriptRig bare("function on_execute() end");
    CHECK(bare.component->script().memory() + 4000 < rig.component->script().memory());
    CHECK(refusal("maths.floor(1)").find("unknown global 'maths'") != std::string::npos);
}
