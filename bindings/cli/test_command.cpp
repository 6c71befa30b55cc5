// `nezumi test`: scenarios, each run in a process of its own.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "bindings/cli/canvas.hpp"
#include "bindings/cli/commands.hpp"
#include "bindings/cli/environment.hpp"
#include "bindings/cli/scenario_files.hpp"
#include "bindings/scenario/reporter.hpp"
#include "bindings/scenario/test_session.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi::cli {
namespace {

struct TestOptions {
    std::vector<std::string> paths;
    std::string filter;
    bool list = false;
    std::uint64_t seed = 124;
    std::uint64_t repeat = 1;
    std::uint64_t jobs = std::max(1U, std::thread::hardware_concurrency());
    std::string junit;
    bool tap = false;
    bool update_goldens = false;
    std::string folder = "nezumi-test";
};

void write_out(std::string_view text) {
    std::fwrite(text.data(), 1, text.size(), stdout);
    std::fflush(stdout);
}

int list(const TestPlan& plan) {
    int status = kDone;
    for (const PlannedFile& file : plan.files) {
        for (const Error& error : file.errors) status = refuse(error);
    }
    for (const PlannedRun& run : plan.runs) {
        const Place& place = plan.files[run.file].scenarios[run.scenario].place;
        fmt::print("{}  {}:{}\n", run.name, place.file, place.line);
    }
    return status;
}

int test(const TestOptions& command) {
    SessionOptions options;
    options.seed = command.seed;
    options.repeat = command.repeat;
    options.jobs = command.jobs;
    options.folder = command.folder;
    options.update_goldens = command.update_goldens;
    options.installed = installed_folders();
    options.systems = simulated_systems;
    options.files = scenario_files;
    const auto plan = plan_tests({.paths = {command.paths.begin(), command.paths.end()},
                                  .filter = command.filter,
                                  .seed = command.seed,
                                  .installed = options.installed});
    if (!plan) return refuse(plan.error());
    if (command.list) return list(*plan);

    if (!command.junit.empty()) {
        // Found out before hours of tests have run.
        if (auto ok = check_can_write(command.junit); !ok) return refuse(ok.error());
    }
    const bool colour = isatty(STDOUT_FILENO) == 1 && std::getenv("NO_COLOR") == nullptr;
    const auto reporter = command.tap ? tap_reporter(write_out) : console_reporter(write_out, colour);
    const SessionEnd end = run_tests(*plan, options, *reporter);
    if (!command.junit.empty()) {
        if (auto ok = write_whole(command.junit, junit_text(end.reports, end.summary)); !ok) return refuse(ok.error());
    }
    if (end.interrupted) return refuse("interrupted: not all scenarios have run");
    return end.status();
}

}  // namespace

Command test_command() {
    auto options = std::make_shared<TestOptions>();
    return {
        .name = "test",
        .help = "Run scenarios: files *_test.lua",
        .options = {{"[PATHS]", &options->paths, "scenario files, and folders that are searched for *_test.lua"},
                    {"--filter", &options->filter, "only runs whose name contains this; a whole name means only that",
                     "TEXT"},
                    {"--list", &options->list, "show the names of the runs and where they are, and run nothing"},
                    {"--seed", &options->seed, "decides everything that is drawn at random", "N",
                     whole_number(0, std::numeric_limits<std::uint64_t>::max(), "2^64 - 1")},
                    {"--repeat", &options->repeat, "make each run so often; all must have the same trace hash", "N",
                     whole_number(1, 1'000'000, "1000000")},
                    {"--jobs", &options->jobs, "processes at a time; the results do not depend on it", "N",
                     whole_number(1, 1024, "1024")},
                    {"--junit", &options->junit, "write the results to this file, as JUnit's XML", "FILE"},
                    {"--tap", &options->tap, "print the results as TAP"},
                    {"--update-goldens", &options->update_goldens, "write the traces of s:golden instead of comparing"},
                    {"-o,--output", &options->folder, "the folder for traces and pictures of failures", "DIR"}},
        .run = [options] { return test(*options); },
        .footer =
            "Without PATHS: the scenarios in tests/ and behaviors/ of the project. Exit status: 0 all passed, 1 "
            "a\nscenario failed, 2 something could not be run."};
}

}  // namespace nezumi::cli
