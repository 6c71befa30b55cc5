// The options of a scenario's words, with units, documentation and limits.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bindings/scenario/expectation.hpp"
#include "bindings/scenario/recordings.hpp"
#include "bindings/scenario/scenario_file.hpp"
#include "engine/ports/setting.hpp"
#include "engine/records/record_shape.hpp"

namespace nezumi {

template <>
struct Describe<Scenario> {
    static constexpr std::string_view name = "scenario_options";
    static constexpr std::string_view doc = "Options of a scenario.";
    static constexpr FieldList fields{
        Setting{"timeout",
                &Scenario::timeout,
                "s",
                "simulated time after which the scenario fails",
                {.range = NumberRange::positive, .most = 1e9}},
        Extra{
            "sweep", "table<string, any[]|Range>", "",
            "one run for each combination, `{ speed = { 0.1, 0.2 }, ... }`, the keys in sorted order. `range(lo, hi)` "
            "instead of a list draws numbers at random, `range(lo, hi, step)` draws from lo, lo + step, ...: all of "
            "them if there are at most `samples`, else without repetition"},
        Extra{"samples",
              "integer",
              "",
              "number of random draws. A failing draw is simplified: to numbers nearer to 0 and with fewer digits, and "
              "to earlier values in their list",
              {.fallback = "20 when a sweep has a range"}},
        Extra{
            "seeds", "integer", "", "number of runs of each combination, each with its own seed", {.fallback = "once"}},
        Extra{"seed",
              "integer",
              "",
              "the seed of every run, as `nezumi run --seed` takes it",
              {.fallback = "a separate seed for each run, from the session's seed and the run's name"}},
        Extra{
            "search",
            "integer",
            "",
            "number of runs that are chosen one after the other, from the sweep and from `s:any`, where margins are "
            "small and lines run for the first time. The search ends with the round of a failure, which is simplified",
            {.fallback = "no search"}},
        Setting{"paired", &Scenario::paired, "",
                "a list of the sweep: runs that differ only in its value have the same seed, and the summary shows the "
                "differences of their measures"},
        Internal{&Scenario::name},
        Internal{&Scenario::place},
        Internal{&Scenario::sweep},
        Internal{&Scenario::seeds},
        Internal{&Scenario::seed},
        Internal{&Scenario::search},
        Internal{&Scenario::draws},
    };
};

template <>
struct Describe<Expectation::Terms> {
    static constexpr std::string_view name = "expectation_options";
    static constexpr std::string_view doc = "Options of an expectation over time.";
    static constexpr std::array<std::string_view, 5> kinds{"always", "never", "wait_until", "eventually", "maintain"};
    static constexpr unsigned wait_until = 1U << 2U, eventually = 1U << 3U, maintain = 1U << 4U;
    static constexpr FieldList fields{
        Setting{"within",
                &Expectation::Terms::within,
                "s",
                "time limit for the event, or for the start of the hold",
                {.range = NumberRange::not_negative,
                 .most = 1e9,
                 .of = wait_until | eventually | maintain,
                 .fallback = "the scenario's timeout"}},
        Setting{"hold",
                &Expectation::Terms::hold,
                "s",
                "how long the condition must stay true",
                {.required = true, .range = NumberRange::not_negative, .most = 1e9, .of = maintain}},
        Internal{&Expectation::Terms::kind},
        Internal{&Expectation::Terms::name},
        Internal{&Expectation::Terms::place},
    };
};

/// The options of `s:golden`.
struct GoldenOptions {
    double tolerance = 1e-9;
};

template <>
struct Describe<GoldenOptions> {
    static constexpr std::string_view name = "golden_options";
    static constexpr std::string_view doc = "Options of a comparison with a committed trace.";
    static constexpr FieldList fields{
        Setting{"tolerance",
                &GoldenOptions::tolerance,
                "",
                "largest allowed difference of a number",
                {.range = NumberRange::not_negative, .most = 1e300}},
    };
};

/// The options of `s:load`. The option for robots is read by the reader of robot files.
struct LoadOptions {};

template <>
struct Describe<LoadOptions> {
    static constexpr std::string_view name = "load_options";
    static constexpr std::string_view doc = "Options of a system that is loaded.";
    static constexpr FieldList fields{
        Extra{"robots", "table<string, RobotModelFields>", "", "changes to the system's robots, by the robot's name"},
    };
};

/// The options of `s:recorded`. The map is read by hand.
struct RecordedOptions {};

template <>
struct Describe<RecordedOptions> {
    static constexpr std::string_view name = "recorded_options";
    static constexpr std::string_view doc = "Options of a recorded run.";
    static constexpr FieldList fields{
        Extra{
            "map",
            "table<string, string>",
            "",
            "names of ports for topics, `{ [\"/scan\"] = \"robot.scan\" }`; only for recordings of other programs and "
            "of real robots",
            {.fallback = "`/a/b` is `a.b`, and `/scan` is `topics.scan`"}},
    };
};

template <>
struct Describe<JudgeRequest> {
    static constexpr std::string_view name = "judge_options";
    static constexpr std::string_view doc = "A behaviour, and the recorded run that it is compared with.";
    static constexpr FieldList fields{
        Setting{"behavior", &JudgeRequest::behavior, "", "its file, or its name", {.required = true}},
        Setting{"component",
                &JudgeRequest::component,
                "",
                "the recorded component",
                {.fallback = "the one with this file"}},
        Setting{"run", &JudgeRequest::run, "", "the recording or journal", {.required = true}},
        Extra{"map", "table<string, string>", "",
              "ports of topics, `{ [\"/scan\"] = \"keeper.rays\" }`: needed for recordings of other programs"},
        Setting{"tolerance",
                &JudgeRequest::tolerance,
                "",
                "largest difference at which two numbers count as equal",
                {.range = NumberRange::not_negative, .most = 1e300}},
        Internal{&JudgeRequest::map},
    };
};

/// The options of `s:reload`: exactly one of them is set.
struct ReloadOptions {
    std::optional<std::string> file;
    std::optional<std::string> text;
};

template <>
struct Describe<ReloadOptions> {
    static constexpr std::string_view name = "reload_options";
    static constexpr std::string_view doc = "The new version of a behaviour: one of these fields.";
    static constexpr FieldList fields{
        Setting{"file", &ReloadOptions::file, "", "the name of its script, searched as in a system file"},
        Setting{"text", &ReloadOptions::text, "", "the script itself"},
    };
};

/// The shapes of these structures.
const std::vector<RecordShape>& scenario_records();

}  // namespace nezumi
