// What the sandbox costs: a call into Lua, the library's tables, traversal, a state and its memory.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <lua.hpp>
#include <memory>
#include <string>

#include "bindings/lua/sandbox/call.hpp"
#include "bindings/lua/sandbox/compile.hpp"
#include "bindings/lua/sandbox/state.hpp"
#include "bindings/lua/sandbox/stdlib.hpp"
#include "bindings/lua/sandbox/strict_globals.hpp"
#include "tests/bench/report.hpp"

namespace nezumi {
namespace {

template <class Result>
void must(const Result& result) {
    if (!result) std::abort();
}

std::unique_ptr<LuaState> make_state() { return std::move(create_sandbox().value()); }

// Leaves the function that the text returns on the stack.
void push_function(LuaState& state, const std::string& text) {
    const Chunk chunk = compile(text, "bench.lua").value();
    must(load_chunk(state.lua(), chunk));
    must(protected_call(state.lua(), 0, 1, Budget{1.0}));
}

void bare_pcall(benchmark::State& bench) {
    const auto state = make_state();
    push_function(*state, "return function() end");
    for (auto _ : bench) {
        lua_pushvalue(state->lua(), 1);
        lua_pcall(state->lua(), 0, 0, 0);
    }
}
BENCHMARK(bare_pcall);

void protected_call_of_an_empty_function(benchmark::State& bench) {
    const auto state = make_state();
    push_function(*state, "return function() end");
    for (auto _ : bench) {
        lua_pushvalue(state->lua(), 1);
        benchmark::DoNotOptimize(protected_call(state->lua(), 0, 0, paced_budget));
    }
}
BENCHMARK(protected_call_of_an_empty_function);

// Times a loop of 1000 rounds of `body`, beside the same in a state with Lua's own library.
void loop(benchmark::State& bench, bool stock, const std::string& before, const std::string& body) {
    std::unique_ptr<LuaState> state = make_state();
    std::unique_ptr<lua_State, void (*)(lua_State*)> plain(luaL_newstate(), lua_close);
    luaL_openlibs(plain.get());
    const std::string text = before + "\nreturn function() for i = 1, 1000 do " + body + " end end";
    lua_State* lua = plain.get();
    if (stock) {
        if (luaL_dostring(lua, text.c_str()) != LUA_OK) std::abort();
    } else {
        push_function(*state, text);
        lua = state->lua();
    }
    for (auto _ : bench) {
        lua_pushvalue(lua, 1);
        if (stock) {
            if (lua_pcall(lua, 0, 0, 0) != LUA_OK) std::abort();
        } else {
            must(protected_call(lua, 0, 0, Budget{10.0}));
        }
    }
    bench.counters["round"] = benchmark::Counter(1000.0 * static_cast<double>(bench.iterations()),
                                                 benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

const char* const five_fields = "local t = { vx = 1, vy = 2, va = 3, heading = 4, name = 5 }";
const char* const four_values = "local t = { 10, 20, 30, 40 }";
const char* const hundred_fields = "local t = {} for i = 1, 100 do t['field' .. i] = i end";
const char* const hundred_values = "local t = {} for i = 1, 100 do t[i] = (i * 7919) % 100 end";

#define NEZUMI_BENCH_LOOP(name, before, body)                                          \
    void name##_sandbox(benchmark::State& bench) { loop(bench, false, before, body); } \
    BENCHMARK(name##_sandbox);                                                         \
    void name##_stock(benchmark::State& bench) { loop(bench, true, before, body); }    \
    BENCHMARK(name##_stock)

NEZUMI_BENCH_LOOP(math_floor, "", "local x = math.floor(2.5)");
NEZUMI_BENCH_LOOP(string_len, "", "local x = ('abc'):len()");
NEZUMI_BENCH_LOOP(string_rep, "", "local x = string.rep('ab', 10)");
NEZUMI_BENCH_LOOP(table_read, five_fields, "local x = t.vx + t.vy");
NEZUMI_BENCH_LOOP(ipairs_of_4, four_values, "for _, v in ipairs(t) do end");
NEZUMI_BENCH_LOOP(pairs_of_4_values, four_values, "for _, v in pairs(t) do end");
NEZUMI_BENCH_LOOP(pairs_of_5_fields, five_fields, "for _, v in pairs(t) do end");
NEZUMI_BENCH_LOOP(pairs_of_100_fields, hundred_fields, "for _, v in pairs(t) do end");
NEZUMI_BENCH_LOOP(next_of_5_fields, five_fields, "if next(t) == nil then error() end");
NEZUMI_BENCH_LOOP(next_of_an_empty_table, "local t = {}", "if next(t) then error() end");
NEZUMI_BENCH_LOOP(pcall_, "local f = function() end", "pcall(f)");
NEZUMI_BENCH_LOOP(tostring_of_a_number, "", "local x = tostring(i)");
NEZUMI_BENCH_LOOP(format, "", "local x = string.format('%d %s', i, 'x')");
NEZUMI_BENCH_LOOP(match, "", "local a, b = ('key = value'):match('^(%w+)%s*=%s*(%w+)$')");
NEZUMI_BENCH_LOOP(gsub, "", "local x = ('hello world from lua'):gsub('%w+', '<%0>')");
NEZUMI_BENCH_LOOP(sort_of_100, hundred_values, "if i % 100 == 0 then table.sort(t) end");
NEZUMI_BENCH_LOOP(coroutine_resume, "local c = coroutine.wrap(function() while true do coroutine.yield() end end)",
                  "c()");

void new_sandbox(benchmark::State& bench) {
    for (auto _ : bench) benchmark::DoNotOptimize(make_state());
    bench.counters["bytes"] = static_cast<double>(make_state()->memory());
}
BENCHMARK(new_sandbox);

const char* const behavior = R"(
local count = 0
local function blocked(values)
  for _, value in ipairs(values) do
    if value > 30 then return true end
  end
  return false
end
function on_execute()
  if blocked { 1, 2, 3, 4 } then count = 0 else count = count + 1 end
end
)";

void compile_a_behavior(benchmark::State& bench) {
    const KnownGlobals known{sandbox_names(), {"on_execute"}};
    for (auto _ : bench) benchmark::DoNotOptimize(compile_checked(behavior, "behavior.lua", known));
}
BENCHMARK(compile_a_behavior);

void load_and_run_a_compiled_behavior_in_a_new_state(benchmark::State& bench) {
    const Chunk chunk = compile(behavior, "behavior.lua").value();
    std::size_t bytes = 0;
    for (auto _ : bench) {
        const auto state = make_state();
        must(make_globals_strict(state->lua(), {"on_execute"}));
        must(load_chunk(state->lua(), chunk));
        must(protected_call(state->lua(), 0, 0, paced_budget));
        bytes = state->memory();
    }
    bench.counters["bytes"] = static_cast<double>(bytes);
}
BENCHMARK(load_and_run_a_compiled_behavior_in_a_new_state);

}  // namespace
}  // namespace nezumi

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    nezumi::bench::print_header(
        "what the sandbox costs",
        "each loop runs 1000 rounds of its body, beside the same with Lua's own library (stock)");
    benchmark::RunSpecifiedBenchmarks();
}
