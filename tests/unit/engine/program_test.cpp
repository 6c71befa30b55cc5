// Other programs: what they are given, how they end, and what is kept of them.
#include "engine/base/program.hpp"

#include <catch2/catch.hpp>
#include <csignal>
#include <thread>

#include "engine/base/thread.hpp"

using namespace nezumi;

TEST_CASE("the output of a program is kept, with its exit status", "[engine][program]") {
    const auto end = run_program({.words = {"sh", "-c", "echo hello; exit 3"}, .keeps_output = true});
    REQUIRE(end);
    CHECK(end->out == "hello\n");
    CHECK(end->status == 3);
    CHECK(end->signal == 0);
    CHECK(problem_of(end) == "it ended with status 3");
}

TEST_CASE("a program reads what it is given, and no shell sees its words", "[engine][program]") {
    const UnnamedFile input("$(id)\n");
    const auto end = run_program({.words = {"cat", "-"}, .input = input.file(), .keeps_output = true});
    REQUIRE(end);
    CHECK(end->out == "$(id)\n");
    CHECK(problem_of(end).empty());
    const UnnamedFile output;
    CHECK(problem_of(run_program({.words = {"echo", "a  b"}, .output = output.file()})).empty());
    CHECK(output.text() == "a  b\n");
    CHECK(output.text(3) == " b\n");
    CHECK(output.text(100) == "a  b\n");
}

TEST_CASE("a program that says much is not kept waiting", "[engine][program]") {
    const auto end = run_program({.words = {"head", "-c", "300000", "/dev/zero"}, .keeps_output = true});
    REQUIRE(end);
    CHECK(end->out.size() == 300000);
}

TEST_CASE("a signal that ends a program is reported by its number", "[engine][program]") {
    const auto end = run_program({.words = {"sh", "-c", "kill -9 $$"}});
    REQUIRE(end);
    CHECK(end->signal == SIGKILL);
    CHECK(end->status == 128 + SIGKILL);
    CHECK(problem_of(end) == "signal 9 ended it");
}

TEST_CASE("a program that is not there is an error", "[engine][program]") {
    CHECK(problem_of(run_program({.words = {"no-such-program"}})) == "No such file or directory");
}

TEST_CASE("a program that takes too long is killed with what it has started", "[engine][program]") {
    const auto end = run_program({.words = {"sh", "-c", "sleep 60; true"}, .longest = 0.1});
    CHECK(problem_of(end) == "it took more than 0.1 s");
}

TEST_CASE("a program is killed at once when it is given up", "[engine][program]") {
    std::atomic<bool> give_up = false;
    std::thread later([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        give_up = true;
    });
    const auto end = run_program({.words = {"sleep", "60"}, .longest = 600, .give_up = &give_up});
    later.join();
    CHECK(problem_of(end) == "it was stopped early");
}

TEST_CASE("a program that a thread without signals starts receives signals", "[engine][program]") {
    Expected<ProgramEnd> end = failure("");
    start_thread([&] { end = run_program({.words = {"sh", "-c", "kill -TERM $$; echo survived"}}); }).join();
    REQUIRE(end);
    CHECK(end->signal == SIGTERM);
}
