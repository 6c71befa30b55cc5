// `nezumi compare`: the first tick in which two runs differ.
#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/base/version.hpp"
#include "bindings/cli/commands/commands.hpp"
#include "bindings/cli/files/run_file.hpp"
#include "bindings/cli/files/run_plot.hpp"
#include "bindings/journal/compare_runs.hpp"
#include "engine/base/visible.hpp"

namespace nezumi::cli {
namespace {

struct LoadedRun {
    std::unique_ptr<Replay> replay;  // declared first: its files must outlive the system
    std::unique_ptr<RunningSystem> system;
};

Expected<LoadedRun> load(const std::string& file) {
    const auto text = read_run(file);
    if (!text) return Unexpected(text.error());
    auto replay = Replay::of_text(*text, file, version());
    if (!replay) return Unexpected(replay.error());
    auto system = (*replay)->load(simulated_systems());
    if (!system) return Unexpected(system.error());
    return LoadedRun{std::move(*replay), std::move(*system)};
}

std::uint64_t seed_of(const LoadedRun& run) { return run.replay->seed_of(run.system->spec()); }

void show(const RunDifference& found, const std::string& first, const std::string& second) {
    const auto text_of = [](const ActTime& when) {
        return fmt::format("tick {}{}", when.tick, when.start == 1 ? "" : fmt::format(" of start {}", when.start));
    };
    fmt::print("first difference: {}, {:g} s\n", text_of(found.when), found.seconds);
    if (text_of(found.when) != text_of(found.second_when))
        fmt::print("  at that time, run {} is at {}\n", visible(second), text_of(found.second_when));
    for (const DifferingValue& value : found.values) {
        fmt::print("  {}: {} and {}{}\n", value.name, value.first, value.second,
                   value.by ? fmt::format(", a difference of {:g}", *value.by) : "");
    }
    if (found.more_values > 0) fmt::print("  and {} more values\n", found.more_values);
    if (!found.lines) return;
    if (found.lines->empty()) {
        fmt::print("{} executed the same lines with the same values\n", found.component);
        return;
    }
    fmt::print("{} executed these lines differently (- in {}, + in {}):\n", found.component, visible(first),
               visible(second));
    for (const DifferingLine& line : *found.lines) fmt::print("  {} {}\n", line.of_first ? '-' : '+', line.text);
}

struct CompareWords {
    std::string first, second, plot;
};

// Repeats both runs to their ends, and draws the fields that differ at the first difference.
Expected<void> draw_difference(const CompareWords& words, const RunDifference& found) {
    std::vector<std::string> fields;
    for (const DifferingValue& value : found.values) fields.push_back(value.name);
    FieldCurves first({fields.begin(), fields.end()}), second({fields.begin(), fields.end()});
    for (const auto& [curves, file, start] : {std::tuple(&first, &words.first, found.when.start),
                                              std::tuple(&second, &words.second, found.second_when.start)}) {
        auto run = load(*file);
        if (!run) return Unexpected(run.error());
        if (auto done = add_curves(*curves, *run->replay, *run->system, start); !done) return done;
    }
    const RunPlot plot{.title = fmt::format("{} and {}", words.first, words.second),
                       .fields = std::move(fields),
                       .first = {"in " + words.first, first},
                       .second = {"in " + words.second, second},
                       .differ_at = found.seconds};
    return draw_runs(plot, words.plot);
}

int compare(const CompareWords& words) {
    const auto& [first, second, plot] = words;
    if (auto ok = need_simulation({{"compare", true}}); !ok) return refuse(ok.error());
    if (auto ok = check_plot(plot); !ok) return refuse(ok.error());
    auto a = load(first);
    if (!a) return refuse(a.error());
    auto b = load(second);
    if (!b) return refuse(b.error());
    const auto compared = compare_runs(*a->replay, *a->system, *b->replay, *b->system);
    if (!compared) return refuse(compared.error());
    if (const auto seeds = std::pair(seed_of(*a), seed_of(*b)); seeds.first != seeds.second)
        fmt::print("different seeds: {} and {}\n", seeds.first, seeds.second);
    for (const std::string& file : compared->files) fmt::print("different files: {}\n", visible(file));
    if (compared->difference) {
        show(*compared->difference, first, second);
        if (plot.empty()) return exit_failed;
        const auto drawn = draw_difference(words, *compared->difference);
        return drawn ? exit_failed : refuse(drawn.error());
    }
    if (!plot.empty()) fmt::print("no plot: nothing differs\n");
    const double common = std::min(compared->first_end, compared->second_end);
    if (compared->first_end == compared->second_end) {
        fmt::print("equal: all messages published in {:g} s\n", common);
        return exit_done;
    }
    const bool first_is_longer = compared->first_end > compared->second_end;
    fmt::print("equal up to {:g} s, where {} ends; {} goes on to {:g} s\n", common,
               visible(first_is_longer ? second : first), visible(first_is_longer ? first : second),
               std::max(compared->first_end, compared->second_end));
    return exit_failed;
}

}  // namespace

SubCommand compare_command() {
    auto words = std::make_shared<CompareWords>();
    return {
        .name = "compare",
        .help = "Compare two runs: the first tick that differs, and the differing values",
        .options =
            {{"FIRST", &words->first, "a journal or a recording of `nezumi run`", "", {}, FileUse::source},
             {"SECOND", &words->second, "the journal or the recording of the other run", "", {}, FileUse::source},
             {"--plot",
              &words->plot,
              "draw both runs, with the first fields that differ",
              "FILE.png|svg",
              {},
              FileUse::result}},
        .run = [words] { return compare(*words); },
        .footer =
            "Both runs are repeated, and every message is compared. Where the first one differs, the executed lines "
            "of the behaviour\nthat published it are compared too.\n"
            "Exit status: 0 the runs are equal, 1 they differ, 2 they could not be compared."};
}

}  // namespace nezumi::cli
