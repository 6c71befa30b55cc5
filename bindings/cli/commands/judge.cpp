// `nezumi judge`: what a behaviour as it is now would have written in a recorded run.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/base/status.hpp"
#include "bindings/cli/base/stop_signals.hpp"
#include "bindings/cli/base/version.hpp"
#include "bindings/cli/commands/commands.hpp"
#include "bindings/cli/files/named_files.hpp"
#include "bindings/cli/files/recorded_drive.hpp"
#include "bindings/journal/drive.hpp"
#include "bindings/record/recorded_run.hpp"
#include "engine/base/visible.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi::cli {
namespace {

namespace fs = std::filesystem;

constexpr double usual_tolerance = 1e-6;
constexpr std::chrono::milliseconds watch_period{100};

struct JudgeWords {
    std::string run, behavior, component, tolerance;
    std::vector<std::string> maps;
    bool watch = false;
};

// What to judge, found once: --watch reads only the behaviour again.
struct JudgedRun {
    std::unique_ptr<Replay> replay;  // its files outlive the system
    std::unique_ptr<RunningSystem> then;
    RecordedDrive drive;
    fs::path behavior;
};

// A replay can't be of real robots, and another program's recording has no journal.
bool can_be_repeated(const record::McapFile& recording, const std::string& name) {
    const auto journal = record::journal_of(recording, name);
    return journal && Replay::of_text(*journal, name, version());
}

Expected<TopicsOfPorts> topics_in(const std::vector<std::string>& maps, std::string& component) {
    TopicsOfPorts topics;
    for (const std::string& each : maps) {
        const std::size_t equal = each.find('='), dot = each.find('.', equal == each.npos ? 0 : equal);
        if (equal == 0 || equal == each.npos || dot == each.npos || dot + 1 == each.size())
            return failure(
                fmt::format("--map: expected TOPIC=COMPONENT.PORT, as in /scan=keeper.rays, got '{}'", shown(each)));
        const std::string of = each.substr(equal + 1, dot - equal - 1);
        if (!component.empty() && component != of)
            return failure(fmt::format("--map: '{}' is not a port of {}", shown(each), component));
        component = of;
        topics[each.substr(dot + 1)] = each.substr(0, equal);
    }
    return topics;
}

// The behaviours of a run with this file, by their names.
std::vector<std::string> users_of(const RunningSystem& live, const fs::path& behavior) {
    std::vector<std::string> names;
    for (const BehaviorEntry* each : entries_of<BehaviorEntry>(live.spec())) {
        if (fs::path(each->path).filename() == behavior.filename()) names.push_back(each->name);
    }
    return names;
}

Expected<JudgedRun> from_journal(const std::string& text, const JudgeWords& words, fs::path behavior) {
    auto replay = Replay::of_text(text, words.run, version());
    if (!replay) return Unexpected(replay.error());
    LiveOptions options = simulated_systems();
    options.build.log = [](const LogLine&) {};
    auto live = (*replay)->load(std::move(options));
    if (!live) return Unexpected(live.error());
    std::string component = words.component;
    if (component.empty()) {
        const std::vector<std::string> users = users_of(**live, behavior);
        if (users.size() != 1) {
            return failure(fmt::format("--component: {} in the recorded system {} {}: give --component NAME",
                                       users.empty() ? "no behaviour" : "several behaviours",
                                       users.empty() ? "has the file" : "have the file", behavior.filename().string()));
        }
        component = users.front();
    }
    auto drive = drive_of(**replay, **live, component);
    if (!drive) return Unexpected(drive.error());
    drive->entry.script = drive->entry.path = behavior.string();
    return JudgedRun{std::move(*replay), std::move(*live), std::move(*drive), std::move(behavior)};
}

Expected<JudgedRun> from_topics(const record::McapFile& recording, const JudgeWords& words, const fs::path& behavior) {
    std::string component = words.component;
    const auto topics = topics_in(words.maps, component);
    if (!topics) return Unexpected(topics.error());
    if (component.empty()) component = behavior.stem().string();
    JudgedRun run{.replay = nullptr, .then = nullptr, .drive = {}, .behavior = behavior};
    run.drive.entry.name = component;
    run.drive.entry.script = run.drive.entry.path = behavior.string();
    SystemSpec alone;
    alone.entries.emplace_back(run.drive.entry);
    LiveOptions options = simulated_systems();
    options.build.log = [](const LogLine&) {};
    auto live = RunningSystem::make(std::move(alone), Project::of(behavior, installed_folders()), std::move(options));
    if (!live) return Unexpected(live.error());
    const Component& its = *std::as_const(**live).system().find(component);
    if (auto read = read_drive(run.drive, recording, words.run, its, *topics); !read) return Unexpected(read.error());
    return run;
}

Expected<JudgedRun> read_judged(const JudgeWords& words) {
    const auto files = find_lua_files(words.behavior);
    if (!files) return Unexpected(files.error());
    const fs::path behavior = files->front();
    auto bytes = read_whole(words.run, words.run, Replay::largest);
    if (!bytes) return Unexpected(bytes.error());
    if (!record::is_mcap(*bytes)) {
        if (!words.maps.empty()) return failure("--map: a journal has no topics: leave it out");
        return from_journal(*bytes, words, behavior);
    }
    const auto recording = record::read_mcap(*bytes, words.run);
    if (!recording) return Unexpected(recording.error());
    if (words.maps.empty() && can_be_repeated(*recording, words.run))
        return from_journal(*record::journal_of(*recording, words.run), words, behavior);
    return from_topics(*recording, words, behavior);
}

void print_first(const Judgement& judged) {
    constexpr std::size_t most = 20;
    for (std::size_t i = 0; i < judged.first.size() && i < most; ++i) {
        const DifferingValue& value = judged.first[i];
        fmt::print("  {}: {} then, {} now{}\n", value.name, value.first, value.second,
                   value.by ? fmt::format(", a difference of {:.6g}", *value.by) : "");
    }
}

void print_lines(JudgedRun& run, const Judgement& judged) {
    const std::string& name = run.drive.entry.name;
    if (run.then != nullptr) {
        const auto then = traced_lines(*run.then, {.start = run.then->when().start, .tick = judged.first_tick}, name);
        if (then && !then->empty()) {
            const auto lines = differing_lines(*then, judged.lines);
            if (!lines.empty()) fmt::print("{} executed these lines differently (- then, + now):\n", name);
            for (const DifferingLine& line : lines) fmt::print("  {} {}\n", line.of_first ? '-' : '+', line.text);
            return;
        }
    }
    if (!judged.lines.empty()) fmt::print("{} executes these lines now:\n", name);
    for (const std::string& line : judged.lines) fmt::print("  {}\n", line);
}

int judge_once(JudgedRun& run, double tolerance) {
    LiveOptions options = simulated_systems();
    options.installed = installed_folders();
    options.build.log = [](const LogLine& line) {
        if (line.level == LogLevel::error) fmt::print(stderr, "{}: {}\n", visible(line.component), visible(line.text));
    };
    options.budget = headless_budget;
    const auto judged = judge(run.drive, Project::of(run.behavior, installed_folders()), options, tolerance);
    if (!judged) return refuse(judged.error());
    for (const std::string& note : judged->notes) fmt::print("{}\n", visible(note));
    const double seconds = static_cast<double>(judged->ticks) / run.drive.rate;
    if (judged->different == 0) {
        fmt::print("equal: what {} writes in {:g} s, {} ticks\n", run.drive.entry.name, seconds, judged->ticks);
        return exit_done;
    }
    fmt::print("different in {} of {} ticks; first in tick {}, {:g} s\n", judged->different, judged->ticks,
               judged->first_tick, judged->first_at);
    print_first(*judged);
    print_lines(run, *judged);
    fmt::print("in all:\n");
    for (const JudgedField& field : judged->fields) {
        fmt::print("  {}: {} ticks{}\n", field.name, field.ticks,
                   field.largest > 0
                       ? fmt::format(", largest difference {:.6g} at {:g} s", field.largest, field.largest_at)
                       : "");
    }
    return exit_failed;
}

// The time of the last change of the behaviour, or of a file beside it.
fs::file_time_type changed_at(const fs::path& behavior) {
    std::error_code none;
    fs::file_time_type last = fs::last_write_time(behavior, none);
    for (const auto& each : fs::directory_iterator(behavior.parent_path(), none)) {
        if (each.path().extension() != ".lua") continue;
        last = std::max(last, fs::last_write_time(each.path(), none));
    }
    return last;
}

int run_judge(const JudgeWords& words) {
    if (auto ok = need_simulation({{"judge", true}}); !ok) return refuse(ok.error());
    double tolerance = usual_tolerance;
    if (!words.tolerance.empty()) {
        const char* const end = words.tolerance.data() + words.tolerance.size();
        const auto [rest, problem] = std::from_chars(words.tolerance.data(), end, tolerance);
        if (problem != std::errc() || rest != end || !(tolerance >= 0))
            return refuse(fmt::format("--tolerance: expected a number from 0 on, got '{}'", shown(words.tolerance)));
    }
    if (words.behavior.empty()) return refuse("--behavior is missing: give --behavior FILE");
    auto run = read_judged(words);
    if (!run) return refuse(run.error());
    if (!words.watch) return judge_once(*run, tolerance);
    const StopSignals signals;
    int status = exit_done;
    std::optional<fs::file_time_type> seen;
    while (signals.received() == 0) {
        if (const auto changed = changed_at(run->behavior); changed != seen) {
            seen = changed;
            status = judge_once(*run, tolerance);
            std::fflush(stdout);
        }
        std::this_thread::sleep_for(watch_period);
    }
    return status;
}

}  // namespace

SubCommand judge_command() {
    auto words = std::make_shared<JudgeWords>();
    return {
        .name = "judge",
        .help = "Give a recorded run to a behaviour as it is now, and compare what it writes",
        .options = {{"RUN",
                     &words->run,
                     "a recording or a journal, which `nezumi run` wrote with --record RUN.mcap or "
                     "--journal; or a recording of ROS 2 in MCAP",
                     "",
                     {},
                     FileUse::source},
                    {"--behavior", &words->behavior, "the behaviour's file, or its name", "FILE", {}, FileUse::source},
                    {"--component", &words->component,
                     "the recorded component (default: the one with this file, or of this name)", "NAME"},
                    {"--map", &words->maps, "the topic of a port, as in /scan=keeper.rays (default: /COMPONENT/PORT)",
                     "TOPIC=NAME.PORT"},
                    {"--tolerance", &words->tolerance, "largest difference of equal numbers (default 1e-6)", "X"},
                    {"--watch", &words->watch,
                     "judge again when the behaviour or a file beside it is saved, until Ctrl-C"}},
        .run = [words] { return run_judge(*words); },
        .footer =
            "The behaviour gets what the component got, tick by tick, with the same parameters, seed and acts. A run "
            "of "
            "nezumi is\nrepeated from its journal. Otherwise messages are taken from the topics of the recording.\n"
            "Exit status: 0 it writes the same, 1 something differs, 2 it could not be judged."};
}

}  // namespace nezumi::cli
