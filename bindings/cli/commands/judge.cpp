// `nezumi judge`: what a behaviour as it is now would have written in a recorded run.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/base/status.hpp"
#include "bindings/cli/base/stop_signals.hpp"
#include "bindings/cli/commands/commands.hpp"
#include "bindings/cli/files/judged_run.hpp"
#include "bindings/cli/files/run_plot.hpp"
#include "engine/base/number_in.hpp"
#include "engine/base/visible.hpp"

namespace nezumi::cli {
namespace {

namespace fs = std::filesystem;

constexpr double usual_tolerance = 1e-6;
constexpr std::chrono::milliseconds watch_period{100};

struct JudgeWords {
    std::string run, behavior, component, tolerance, plot;
    std::vector<std::string> maps;
    bool watch = false;
};

// Parses --map: "/scan=keeper.rays" is the topic /scan for the port `rays` of `keeper`.
Expected<std::map<std::string, std::string>> read_maps(const std::vector<std::string>& maps) {
    std::map<std::string, std::string> all;
    for (const std::string& each : maps) {
        const std::size_t equal = each.find('=');
        if (equal == each.npos) {
            return failure(
                fmt::format("--map: expected TOPIC=COMPONENT.PORT, as in /scan=keeper.rays, got '{}'", shown(each)));
        }
        all[each.substr(0, equal)] = each.substr(equal + 1);
    }
    return all;
}

// Draws the fields that differ, or all fields if none differs.
Expected<void> draw_judgement(const JudgeWords& words, const Judgement& judged, const JudgedCurves& curves) {
    RunPlot plot{.title = fmt::format("{} in {}", words.behavior, words.run),
                 .fields = {},
                 .first = {"then", curves.then},
                 .second = {"now", curves.now},
                 .differ_at = {}};
    for (const JudgedField& field : judged.fields) plot.fields.push_back(field.name);
    if (judged.different > 0) {
        plot.differ_at = judged.first_at;
    } else {
        plot.fields = curves.then.names();
    }
    return draw_runs(plot, words.plot);
}

int judge_once(const JudgedRun& run, double tolerance, const JudgeWords& words) {
    JudgedCurves curves;
    const auto log = [](const LogLine& line) {
        if (line.level == LogLevel::error) fmt::print(stderr, "{}: {}\n", visible(line.component), visible(line.text));
    };
    const auto judged = run.judge(tolerance, log, words.plot.empty() ? nullptr : &curves);
    if (!judged) return refuse(judged.error());
    for (const std::string& line : run.text_of(*judged)) fmt::print("{}\n", line);
    if (!words.plot.empty()) {
        if (auto drawn = draw_judgement(words, *judged, curves); !drawn) return refuse(drawn.error());
    }
    return judged->different == 0 ? exit_done : exit_failed;
}

// The time of the last change of the behaviour's file, or of another Lua file in its folder.
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
        tolerance = number_in<double>(words.tolerance).value_or(-1);
        if (!(tolerance >= 0))
            return refuse(fmt::format("--tolerance: expected a number from 0 on, got '{}'", shown(words.tolerance)));
    }
    if (words.behavior.empty()) return refuse("--behavior is missing: give --behavior FILE");
    if (auto ok = check_plot(words.plot); !ok) return refuse(ok.error());
    auto map = read_maps(words.maps);
    if (!map) return refuse(map.error());
    auto run = JudgedRun::read(
        {.behavior = words.behavior, .component = words.component, .run = words.run, .map = std::move(*map)});
    if (!run) return refuse(run.error());
    if (!words.watch) return judge_once(*run, tolerance, words);
    const StopSignals signals;
    int status = exit_done;
    std::optional<fs::file_time_type> seen;
    while (signals.received() == 0) {
        if (const auto changed = changed_at(run->behavior()); changed != seen) {
            seen = changed;
            status = judge_once(*run, tolerance, words);
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
                    {"--tolerance", &words->tolerance, "numbers with at most this difference are equal (default 1e-6)",
                     "X"},
                    {"--plot",
                     &words->plot,
                     "draw what differs: what was written then, and what is written now",
                     "FILE.png|svg",
                     {},
                     FileUse::result},
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
