// Tasks in processes of their own, what they send back, and how results are told to machines.
#include <catch2/catch.hpp>

#include <csignal>
#include <unistd.h>

#include "bindings/scenario/planned_run.hpp"
#include "bindings/scenario/process_pool.hpp"
#include "bindings/scenario/reporter.hpp"
#include "engine/trace/text_plot.hpp"

using namespace nezumi;

TEST_CASE("answers are in the order of the tasks, for any durations", "[lua][scenario][pool]") {
    std::string all;
    PoolTasks tasks;
    tasks.count = 6;
    tasks.run = [](std::size_t task) {
        usleep(static_cast<useconds_t>((6 - task) * 5000));
        return std::to_string(task) + std::string(200'000, '.');
    };
    tasks.take = [&](std::size_t, const Expected<std::string>& answer) {
        REQUIRE(answer);
        REQUIRE(answer->size() == 200'001);
        all += answer->front();
    };
    CHECK(run_in_processes(tasks, 3) == PoolEnd::done);
    CHECK(all == "012345");
}

TEST_CASE("a crash of a process ends only its task", "[lua][scenario][pool]") {
    std::vector<std::string> all;
    PoolTasks tasks;
    tasks.count = 3;
    tasks.run = [](std::size_t task) -> std::string {
        if (task == 1) kill(getpid(), SIGKILL);
        return "fine";
    };
    tasks.take = [&](std::size_t, const Expected<std::string>& answer) {
        all.push_back(answer ? *answer : answer.error().message);
    };
    CHECK(run_in_processes(tasks, 2) == PoolEnd::done);
    CHECK(all == std::vector<std::string>{"fine", "its process was ended by signal 9 (Killed)", "fine"});
}

TEST_CASE("an interruption ends all processes at once", "[lua][scenario][pool]") {
    PoolTasks tasks;
    tasks.count = 4;
    tasks.run = [](std::size_t task) -> std::string {
        if (task == 1) kill(getppid(), SIGTERM);
        for (;;) pause();
    };
    tasks.take = [&](std::size_t, const Expected<std::string>&) { FAIL("nothing was to be done"); };
    CHECK(run_in_processes(tasks, 2) == PoolEnd::interrupted);
}

TEST_CASE("an interruption loses no answer of a finished task", "[lua][scenario][pool]") {
    std::vector<std::size_t> all;
    PoolTasks tasks;
    tasks.count = 4;
    tasks.run = [](std::size_t task) -> std::string {
        if (task == 3) kill(getppid(), SIGTERM);
        while (task == 0 || task == 3) pause();
        return "fine";
    };
    tasks.take = [&](std::size_t task, const Expected<std::string>& answer) {
        CHECK(answer.value_or("") == "fine");
        all.push_back(task);
    };
    CHECK(run_in_processes(tasks, 2) == PoolEnd::interrupted);
    CHECK(all == std::vector<std::size_t>{1, 2});
}

TEST_CASE("a hangup interrupts like other signals, unless it is ignored", "[lua][scenario][pool]") {
    PoolTasks tasks;
    tasks.count = 1;
    tasks.run = [](std::size_t) -> std::string {
        kill(getppid(), SIGHUP);
        usleep(100'000);
        return "fine";
    };
    tasks.take = [](std::size_t, const Expected<std::string>&) {};
    const auto before = std::signal(SIGHUP, SIG_DFL);  // nohup ignores it
    CHECK(run_in_processes(tasks, 1) == PoolEnd::interrupted);
    std::signal(SIGHUP, SIG_IGN);
    CHECK(run_in_processes(tasks, 1) == PoolEnd::done);
    std::signal(SIGHUP, before);
}

TEST_CASE("a pool reports the number of finished tasks after each task", "[lua][scenario][pool]") {
    std::vector<std::size_t> told;
    PoolTasks tasks;
    tasks.count = 3;
    tasks.run = [](std::size_t) { return std::string(); };
    tasks.take = [](std::size_t, const Expected<std::string>&) {};
    tasks.progress = [&](std::size_t done) { told.push_back(done); };
    CHECK(run_in_processes(tasks, 2) == PoolEnd::done);
    CHECK(told == std::vector<std::size_t>{1, 2, 3});
}

TEST_CASE("a result is sent as bytes, and incomplete bytes are an error", "[lua][scenario][pool]") {
    RunResult result{.outcome = RunOutcome::failed,
                     .error = {"no", {"a.lua", 3, 4}},
                     .facts = {"one", "", std::string("\0\n", 2)},
                     .margins = {{.kind = "always", .condition = "m", .margin = 0.5, .time = 1, .left = 2}},
                     .folder = "x",
                     .seconds = 1.5,
                     .hash = 0x1234567890abcdef};
    const std::string bytes = to_bytes(result);
    const auto back = from_bytes(bytes);
    REQUIRE(back);
    CHECK(*back == result);
    for (std::size_t size = 0; size < bytes.size(); ++size) CHECK_FALSE(from_bytes(bytes.substr(0, size)));
}

TEST_CASE("every text of a scenario is valid in JUnit's XML", "[lua][scenario][report]") {
    RunReport report{.file = "a_test.lua", .line = 3, .scenario = "x", .name = "x [a=\"<&\x01\xff\xc3\xa9]"};
    report.result.outcome = RunOutcome::failed;
    report.result.error = {"a < b & \"c\"", {"a_test.lua", 4}};
    report.result.printed = {"]]>", "two\x1b[0m", std::string("be\0hind", 7)};
    const std::string text = junit_text({report}, {.failed = 1, .seed = 124});
    CHECK(text.find("tests=\"1\" failures=\"1\" errors=\"0\"") != std::string::npos);
    CHECK(text.find("name=\"x [a=&quot;&lt;&amp;??\xc3\xa9]\"") != std::string::npos);
    CHECK(text.find("<failure message=\"a &lt; b &amp; &quot;c&quot;\" type=\"failed\">") != std::string::npos);
    CHECK(text.find("<system-out>]]&gt;&#10;two?[0m&#10;be?hind&#10;</system-out>") != std::string::npos);
}

TEST_CASE("TAP counts all runs, and escapes directives", "[lua][scenario][report]") {
    std::string text;
    const auto reporter = tap_reporter([&](std::string_view more) { text += more; });
    reporter->begin(2);
    RunReport report{.file = "a_test.lua", .line = 3, .scenario = "x # SKIP", .name = "x # SKIP"};
    reporter->add(report);
    report.result.outcome = RunOutcome::could_not_run;
    report.result.error = {"no \"file\"", {"a_test.lua", 4}};
    reporter->add(report);
    CHECK(
        text.starts_with("TAP version 13\n1..2\nok 1 - a_test.lua: x \\# SKIP\nnot ok 2 - a_test.lua: x \\# SKIP\n"
                         "  ---\n  message: \"no \\\"file\\\"\"\n  severity: error\n  at: \"a_test.lua:4\"\n"));
    CHECK(text.ends_with("  ...\n"));
}

TEST_CASE("a plot shows curves between the smallest and the largest value", "[lua][scenario][report]") {
    const Curve limit{"limit", {{0, 1}, {3, 1}}, '-'}, x{"x", {{0, 0}, {1, 1}, {2, 2}, {3, 3}}, '*'};
    CHECK(plain_plot({limit, x}, {.columns = 17, .rows = 4}) ==
          std::vector<std::string>{"3 |                *", "  |           ******", "  |-----*******-----", "0 |******",
                                   "   0 s           3 s", "   - limit   * x"});
    CHECK(plain_plot({{"none"}}, {}).empty());
}

TEST_CASE("runs that should be equal are reported with their hashes, or with their outcomes", "[lua][scenario]") {
    const RunResult passed{.hash = 7};
    const RunResult failed{.outcome = RunOutcome::failed, .hash = 7};
    const auto told = [](const RunResult& first, const RunResult& second) {
        return agree({first, second}, {"it_test.lua", 1}).error.message;
    };
    CHECK(told(passed, passed).empty());
    CHECK(told(passed, failed) == "repetitions of this run differ: the first passed, number 2 failed");
    CHECK(told(failed, {.hash = 0x2a}) ==
          "repetitions of this run differ: the first has hash 0000000000000007, number 2 has hash 000000000000002a");
}
