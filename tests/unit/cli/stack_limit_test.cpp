// How much stack the system gives.
#include <sys/resource.h>

#include <catch2/catch.hpp>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;

namespace {

// Runs with a limit of the stack, which a program takes over from the one that starts it.
Outcome run_with_stack(rlim_t bytes, std::vector<std::string> words, const std::string& folder = "") {
    rlimit before{};
    REQUIRE(getrlimit(RLIMIT_STACK, &before) == 0);
    const rlimit less{bytes, before.rlim_max};
    REQUIRE(setrlimit(RLIMIT_STACK, &less) == 0);
    Outcome outcome = run_nezumi(std::move(words), folder);
    setrlimit(RLIMIT_STACK, &before);
    return outcome;
}

}  // namespace

TEST_CASE("a stack that is too small is an error that says what to do", "[cli]") {
    const rlim_t bytes = GENERATE(rlim_t{64} << 10, rlim_t{1} << 20);
    const Outcome outcome = run_with_stack(bytes, {"--version"});
    CHECK(outcome.status == 2);
    CHECK(outcome.error == "nezumi: the stack limit is " + std::to_string(bytes >> 10) +
                               " kB, at least 2048 kB are needed: run `ulimit -s 8192` first\n");
}

TEST_CASE("the smallest stack that is admitted holds what a behaviour may use of it", "[cli]") {
    const Scratch scratch;
    scratch.write("behaviors/deep.lua",
                  "local function f(s) return (s:gsub('.', f)) end\n"
                  "local function g() table.sort({ 1, 2, 3 }, g) end\n"
                  "local function h() coroutine.wrap(h)() end\n"
                  "function on_execute() pcall(f, 'x') pcall(g) pcall(h) f('x') end\n");
    scratch.write("system.lua", "behavior 'deep' { script = 'deep' }\n");
    const Outcome outcome =
        run_with_stack(rlim_t{2} << 20, {"run", "system.lua", "--headless", "--speed", "max", "--duration", "0.1"},
                       scratch.path("").string());
    INFO(outcome.error);
    CHECK(outcome.status <= 1);
    CHECK(outcome.error.find("stack overflow") != std::string::npos);
}
