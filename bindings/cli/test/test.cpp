// The requested output files are checked before the first run, and written after the last one.
#include "bindings/cli/test/test.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <sstream>
#include <system_error>
#include <thread>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/base/status.hpp"
#include "bindings/cli/base/version.hpp"
#include "bindings/cli/files/named_files.hpp"
#include "bindings/cli/files/output_files.hpp"
#include "bindings/cli/run/hardware.hpp"
#include "bindings/cli/run/options.hpp"
#include "bindings/cli/run/run.hpp"
#include "bindings/cli/test/coverage_files.hpp"
#include "bindings/cli/test/parts.hpp"
#include "bindings/cli/test/progress.hpp"
#include "bindings/cli/test/recordings.hpp"
#include "bindings/cli/test/scenario_files.hpp"
#include "bindings/cli/test/shown_run.hpp"
#include "bindings/cli/test/sweep_plots.hpp"
#include "bindings/cli/test/watch.hpp"
#include "bindings/scenario/margins.hpp"
#include "bindings/scenario/measures.hpp"
#include "bindings/scenario/mutate.hpp"
#include "bindings/scenario/reporter.hpp"
#include "bindings/scenario/test_session.hpp"
#include "engine/base/whole_file.hpp"
#include "hw/rig/rig_world.hpp"

namespace nezumi::cli {
namespace {

// Sockets by robot, of "mouse=a.socket,ev3=b.socket".
Expected<std::map<std::string, std::string>> read_rig(const std::string& words) {
    std::map<std::string, std::string> sockets;
    std::istringstream parts(words);
    for (std::string part; std::getline(parts, part, ',');) {
        const auto equals = part.find('=');
        if (equals == std::string::npos || equals == 0 || equals + 1 == part.size() ||
            !sockets.try_emplace(part.substr(0, equals), part.substr(equals + 1)).second)
            return failure(fmt::format("--rig: expected a socket for each robot as in mouse=mouse.socket, got '{}'",
                                       shown(words)));
    }
    return sockets;
}

// Sets the options for real robots if there is --hw. Fails if other options are impossible with --hw.
Expected<void> choose_robots(const TestOptions& command, TestSessionOptions& options) {
    if (!command.hw) {
        for (const auto& [option, given] : {std::pair{"--rig", !command.rig.empty()},
                                            {"--dev-root", !command.dev_root.empty()},
                                            {"--sys-root", !command.sys_root.empty()}}) {
            if (given) return failure(fmt::format("{} is for real robots: give --hw as well", option));
        }
        return {};
    }
    auto fits = refuse_given({{"--repeat", command.repeat.value_or(1) > 1},
                              {"--update-goldens", command.update_goldens},
                              {"--shard", !command.shard.empty()},
                              {"--resume", command.resume}},
                             "--hw: two runs of a real robot always differ");
    if (!fits) return fits;
    auto sockets = read_rig(command.rig);
    if (!sockets) return Unexpected(sockets.error());
    Hardware hardware;
    if (!command.dev_root.empty()) hardware.dev_root = command.dev_root;
    if (!command.sys_root.empty()) hardware.sys_root = command.sys_root;
    options.is_real = true;
    options.jobs = 1;
    options.words = " --hw";
    for (const auto& [option, given] :
         {std::pair{"--rig", command.rig}, {"--dev-root", command.dev_root}, {"--sys-root", command.sys_root}}) {
        if (!given.empty()) options.words += fmt::format(" {} {}", option, shell_text(given));
    }
    options.systems = [hardware, sockets = std::move(*sockets)] {
        LiveOptions live = simulated_systems();
        use_hardware(live, hardware, {.dev = hardware.dev_root, .sys = hardware.sys_root});
        live.rig = [sockets](const SystemSpec& spec) { return hw::open_rig(spec, sockets); };
        return live;
    };
    return {};
}

// Only a test rig can move real robots back to the start of the next run. Without a rig, only one run is possible.
Expected<void> check_is_one(const TestOptions& command, const TestPlan& plan) {
    if (!command.hw || !command.rig.empty() || plan.runs.size() <= 1) return {};
    return failure(fmt::format(
        "--hw: these are {} runs, and the robots are not moved back between them: choose one by --filter (--list shows "
        "their names), or give --rig",
        plan.runs.size()));
}

void write_out(std::string_view text) {
    std::fwrite(text.data(), 1, text.size(), stdout);
    std::fflush(stdout);
}

void write_error(std::string_view text) { std::fwrite(text.data(), 1, text.size(), stderr); }

int list(const TestPlan& plan, const Shard& shard) {
    int status = exit_done;
    for (const PlannedFile& file : plan.files) {
        for (const Error& error : file.errors) status = refuse(error);
    }
    for (std::size_t i = 0; i < plan.runs.size(); ++i) {
        if (!shard.has(i)) continue;
        const PlannedRun& run = plan.runs[i];
        const Place& place = plan.files[run.file].scenarios[run.scenario].place;
        fmt::print("{}  {}:{}\n", run.name, place.file, place.line);
    }
    return status;
}

// Shows the changes of a behaviour that no scenario notices.
int mutate_file(const TestOptions& command, TestPlan plan, TestSessionOptions& options) {
    const auto files = find_lua_files(command.mutate);
    if (!files) return refuse(files.error());
    // The runs of a search are left out: they depend on the results of other runs.
    std::erase_if(plan.runs, [](const PlannedRun& run) { return run.searched; });
    SweepProgress progress(write_error, isatty(STDERR_FILENO) == 1);
    options.progress = [&](std::size_t done, std::size_t all) { progress.update(done, all); };
    const auto report = mutate(plan, files->front(), options);
    progress.clear();
    if (!report) return refuse(report.error());
    if (report->interrupted) return refuse("interrupted: not all changes were tried");
    write_out(report->text());
    return report->noticed() == report->tried.size() ? exit_done : exit_failed;
}

// The options that are impossible with --watch, --show and --mutate.
GivenOptions ways_and_results(const TestOptions& command) {
    return {{"--list", command.list},
            {"--merge", command.merge},
            {"--open", command.open},
            {"--hw", command.hw},
            {"--shard", !command.shard.empty()},
            {"--resume", command.resume},
            {"--update-goldens", command.update_goldens},
            {"--junit", !command.junit.empty()},
            {"--measures", !command.measures.empty()},
            {"--margins", !command.margins.empty()},
            {"--plots", !command.plots.empty()},
            {"--coverage", !command.coverage.empty()}};
}

Expected<void> refuse_ways(const TestOptions& command, const GivenOptions& others, std::string_view why) {
    GivenOptions given = ways_and_results(command);
    given.insert(given.end(), others.begin(), others.end());
    return refuse_given(given, why);
}

// Fails if two options contradict each other.
Expected<void> check_options(const TestOptions& command) {
    if (command.watch) {
        auto ok = refuse_ways(command, {{"--mutate", !command.mutate.empty()}},
                              "--watch runs only the scenarios that a saved file affects");
        if (!ok) return ok;
    }
    if (command.show) {
        auto ok = refuse_ways(command,
                              {{"--mutate", !command.mutate.empty()},
                               {"--watch", command.watch},
                               {"--repeat", command.repeat.has_value()},
                               {"--search", command.search.has_value()}},
                              "--show only shows one run");
        if (!ok) return ok;
    } else {
        for (const auto& [option, given] :
             {std::pair{"--port", !command.page.port.empty()}, {"--listen", !command.page.listen.empty()}}) {
            if (given) return failure(fmt::format("{} is for the page of a run: give --show as well", option));
        }
    }
    const GivenOptions parts{{"--shard", !command.shard.empty()}, {"--resume", command.resume}};
    if (command.open) {
        auto fits = refuse_given({{"--list", command.list}, {"--hw", command.hw}, {"--merge", command.merge}},
                                 "--open shows a run of this command");
        if (!fits) return fits;
    }
    auto ok = refuse_given({{"--quiet", command.tap && command.quiet}}, "--tap reports every run");
    if (ok && command.search)
        ok = refuse_given({{"--hw", command.hw}, {"--update-goldens", command.update_goldens}},
                          "--search chooses simulated runs by their results");
    if (ok && !command.mutate.empty()) {
        ok = refuse_ways(command,
                         {{"--search", command.search.has_value()},
                          {"--repeat", command.repeat.has_value()},
                          {"--tap", command.tap}},
                         "--mutate shows only changes that no scenario notices");
    }
    if (ok && command.hw)
        ok = refuse_given({{"--coverage", !command.coverage.empty()}}, "--hw: coverage is measured only in simulation");
    if (ok && command.update_goldens) ok = refuse_given(parts, "--update-goldens needs the results of all runs");
    if (!ok || !command.merge) return ok;
    ok = refuse_given(parts, "--merge only reports runs that have already finished");
    if (ok) {
        ok = refuse_given({{"--filter", !command.filter.empty()},
                           {"--list", command.list},
                           {"--seed", command.seed.has_value()},
                           {"--seeds", !command.seeds.empty()},
                           {"--paired", !command.paired.empty()},
                           {"--search", command.search.has_value()},
                           {"--repeat", command.repeat.has_value()},
                           {"--jobs", command.jobs.has_value()},
                           {"-o", command.folder != TestOptions{}.folder},
                           {"--hw", command.hw},
                           {"--update-goldens", command.update_goldens}},
                          "--merge only reports runs that have already finished");
    }
    if (ok && command.paths.empty())
        return failure("--merge: expected the folders of the parts, as in nezumi test --merge part-*");
    return ok;
}

// Runs the plan. With --shard, stores it first, for --merge.
Expected<SessionEnd> run_plan(const TestOptions& command, const TestPlan& plan, TestSessionOptions& options,
                              Reporter& reporter) {
    options.made_with = fingerprint(plan, options.seed, version(), options.installed);
    if (options.coverage) options.made_with = mix(options.made_with, "coverage");
    if (!command.shard.empty()) {
        const KeptPlan kept{.plan = plan,
                            .made_with = options.made_with,
                            .seed = options.seed,
                            .repeat = options.repeat,
                            .shards = options.shard.count,
                            .words = options.words};
        if (auto ok = keep_plan(options.folder, options.shard, kept); !ok) return Unexpected(ok.error());
    }
    return run_tests(plan, options, reporter);
}

// Makes the project's folder the working folder. The files of --junit, --measures, --margins, --plots and --coverage
// stay in the user's working folder.
Expected<void> enter_project(TestOptions& command) {
    namespace fs = std::filesystem;
    std::error_code problem;
    if (!fs::is_directory(fs::path(command.project) / "behaviors", problem))
        return failure("--project: expected a project, a folder that has behaviors/", {command.project});
    for (std::string* file : {&command.junit, &command.measures, &command.margins, &command.plots, &command.coverage}) {
        if (!file->empty()) *file = fs::absolute(*file).string();
    }
    fs::current_path(command.project, problem);
    if (problem) return failure(fmt::format("--project: {}", problem.message()), {command.project});
    return {};
}

// Reports the results of the session, and writes the requested files.
int finish(const TestOptions& command, SessionEnd end) {
    if (!command.junit.empty()) {
        if (auto ok = write_whole(command.junit, junit_text(end.reports, end.summary)); !ok) return refuse(ok.error());
    }
    if (!command.measures.empty()) {
        if (auto ok = write_whole(command.measures, measures_csv(end.measured)); !ok) return refuse(ok.error());
    }
    if (!command.margins.empty()) {
        if (auto ok = write_whole(command.margins, margins_csv(end.measured)); !ok) return refuse(ok.error());
    }
    if (!command.plots.empty()) {
        const auto plots = sweep_plots(end.measured);
        for (const draw::SweepPlot& plot : plots) {
            if (auto ok = draw::draw_sweep_plot(plot, command.plots); !ok) return refuse(ok.error());
        }
        if (plots.empty()) fmt::print(stderr, "nezumi: --plots: nothing was measured over a swept parameter\n");
    }
    if (!command.coverage.empty()) {
        if (end.coverage.empty() && command.merge)
            return refuse("--coverage: the parts have no coverage: make them with --coverage too");
        // Only if all scenarios of the project were run: otherwise other scenarios may load these files.
        if (command.filter.empty() && (command.paths.empty() || command.merge)) add_unloaded_files(end.coverage);
        if (auto ok = write_coverage(end.coverage, command.coverage); !ok) return refuse(ok.error());
        // TAP allows only comments between its lines.
        fmt::print("{}{}\n", command.tap ? "# " : "", end.coverage.summary());
    }
    if (command.open && !end.interrupted) {
        for (const RunReport& report : end.reports) {
            if (report.result.outcome != RunOutcome::failed || report.result.folder.empty()) continue;
            RunWords words;
            words.replay = report.result.folder;
            words.opens_replay = true;
            words.batch = isatty(STDIN_FILENO) == 0;
            auto options = read_run_options(words);
            if (!options) return refuse(options.error());
            const int status = run_system(std::move(*options));
            return status == exit_done ? end.status() : status;
        }
    }
    if (end.interrupted)
        return refuse(end.can_resume ? "interrupted: not all scenarios have run; --resume runs the others"
                                     : "interrupted: not all scenarios have run");
    return end.status();
}

}  // namespace

int test(TestOptions command) {
    if (auto ok = check_options(command); !ok) return refuse(ok.error());
    std::error_code gone;
    static_cast<void>(std::filesystem::current_path(gone));
    if (gone) return refuse("test: the working folder has been deleted: change to another folder");
    if (!command.project.empty()) {
        if (auto ok = enter_project(command); !ok) return refuse(ok.error());
    }
    if (auto ok = need_simulation({{"test without --hw", !command.hw && !command.list && !command.merge},
                                   {"--plots", !command.plots.empty()}});
        !ok)
        return refuse(ok.error());
    TestSessionOptions options;
    options.seed = command.seed.value_or(usual_seed);
    options.repeat = static_cast<std::size_t>(command.repeat.value_or(1));
    options.jobs = static_cast<std::size_t>(command.jobs.value_or(std::max(1U, std::thread::hardware_concurrency())));
    options.folder = command.folder;
    options.update_goldens = command.update_goldens;
    options.installed = installed_folders();
    options.peer_words = peer_words();
    options.resume = command.resume;
    options.keep = command.resume || !command.shard.empty();
    options.coverage = !command.coverage.empty();
    options.systems = simulated_systems;
    options.recordings = &recordings();
    options.files = scenario_files;
    if (auto ready = choose_robots(command, options); !ready) return refuse(ready.error());
    if (!command.project.empty()) options.words += " --project " + shell_text(command.project);
    if (!command.paired.empty()) options.words += " --paired " + shell_text(command.paired);
    const auto seeds = read_seeds(command.seeds);
    if (!seeds) return refuse(seeds.error());
    const auto shard = read_shard(command.shard);
    if (!shard) return refuse(shard.error());
    options.shard = *shard;
    const std::vector<std::filesystem::path> paths(command.paths.begin(), command.paths.end());
    std::function<Expected<SessionEnd>(Reporter&)> session;
    if (command.merge) {
        auto kept = find_plan(paths);
        if (!kept) return refuse(kept.error());
        session = [&paths, kept = std::move(*kept)](Reporter& reporter) { return merge_tests(kept, paths, reporter); };
    } else {
        const auto make_plan = [&] {
            return plan_tests({.paths = paths,
                               .filter = command.filter,
                               .seed = options.seed,
                               .installed = options.installed,
                               .peer_words = options.peer_words,
                               .seeds = *seeds,
                               .search = static_cast<std::size_t>(command.search.value_or(0)),
                               .paired = command.paired});
        };
        if (command.watch) {
            const bool has_colour = isatty(STDOUT_FILENO) == 1 && std::getenv("NO_COLOR") == nullptr;
            return watch_tests(paths, make_plan, options, [&] {
                return command.tap ? tap_reporter(write_out) : console_reporter(write_out, has_colour, command.quiet);
            });
        }
        auto plan = make_plan();
        if (!plan) return refuse(plan.error());
        if (command.list) return list(*plan, options.shard);
        if (!command.mutate.empty()) return mutate_file(command, *plan, options);
        if (command.show) {
            const auto web = read_web(command.page, false);
            if (!web) return refuse(web.error());
            const bool has_colour = isatty(STDOUT_FILENO) == 1 && std::getenv("NO_COLOR") == nullptr;
            const auto shown = command.tap ? tap_reporter(write_out) : console_reporter(write_out, has_colour);
            return show_run(*plan, options, **web, *shown);
        }
        if (auto one = check_is_one(command, *plan); !one) return refuse(one.error());
        session = [&, plan = std::move(*plan)](Reporter& reporter) {
            return run_plan(command, plan, options, reporter);
        };
    }

    for (const std::string& file : {command.junit, command.measures, command.margins}) {
        if (file.empty()) continue;
        // Checked before the tests, which may run for hours.
        if (auto ok = check_can_write(file); !ok) return refuse(ok.error());
    }
    for (const std::string& folder : {command.plots, command.coverage}) {
        if (folder.empty()) continue;
        std::error_code problem;
        std::filesystem::create_directories(folder, problem);
        if (problem) return refuse(Error{fmt::format("can't be made: {}", problem.message()), {folder}});
    }
    const bool colour = isatty(STDOUT_FILENO) == 1 && std::getenv("NO_COLOR") == nullptr;
    SweepProgress progress(write_error, isatty(STDERR_FILENO) == 1);
    options.progress = [&](std::size_t done, std::size_t all) { progress.update(done, all); };
    const auto write = [&](std::string_view text) {
        progress.clear();
        write_out(text);
    };
    const auto reporter = command.tap ? tap_reporter(write) : console_reporter(write, colour, command.quiet);
    auto end = session(*reporter);
    progress.clear();
    return end ? finish(command, std::move(*end)) : refuse(end.error());
}

}  // namespace nezumi::cli
