// What a component got and wrote in a recorded run, to try another version of its behaviour with it.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/journal/compare_runs.hpp"
#include "bindings/journal/field_curves.hpp"
#include "bindings/journal/recorded_device.hpp"
#include "bindings/journal/replay.hpp"
#include "engine/base/error.hpp"
#include "engine/live/running_system.hpp"
#include "engine/ports/port.hpp"

namespace nezumi {

struct RecordedDrive {
    BehaviorEntry entry;          ///< of the component: its name, rate, parameters and sets
    double rate = 100;            ///< [Hz] of the tick
    double physics_step = 0.005;  ///< [s]
    std::uint64_t seed = 0;       ///< of the run
    std::int64_t ticks = 0;
    std::vector<double> times{};  ///< [s] of the ticks, where the clock decided them; empty: a tick lasts 1 / rate
    std::map<std::string, DrivePort, std::less<>> arrived{};    ///< at in-ports, by their names
    std::map<std::string, DrivePort, std::less<>> published{};  ///< by out-ports
    std::vector<std::pair<std::int64_t, Act>> acts{};           ///< on the component, before these ticks
    std::vector<std::string> notes{};                           ///< for the user
};

/// The behaviour with this name in a recorded system; the error names those that it has.
Expected<const BehaviorEntry*> recorded_behavior(const SystemSpec& spec, const std::string& component);

/// Repeats a run, and keeps what this component got and wrote; up to the first restart. An error if the run can't be
/// repeated, or the component is not in its system file.
Expected<RecordedDrive> drive_of(Replay& replay, RunningSystem& live, const std::string& component);

/// A value that a behaviour writes otherwise than in the recorded run.
struct JudgedField {
    std::string name;        ///< "keeper.out.vx"
    std::int64_t ticks = 0;  ///< in which it differs
    double largest = 0;      ///< difference of numbers
    double largest_at = 0;   ///< [s]
    bool operator==(const JudgedField&) const = default;
};

struct Judgement {
    std::int64_t ticks = 0;               ///< in all
    std::int64_t different = 0;           ///< in which something differs by more than the tolerance
    std::vector<JudgedField> fields{};    ///< that differ
    std::vector<DifferingValue> first{};  ///< in the first tick that differs
    double first_at = 0;                  ///< [s] of this tick
    std::int64_t first_tick = 0;
    std::vector<std::string> lines{};  ///< of the behaviour that were executed in this tick, with their values
    std::vector<std::string> notes{};  ///< for the user
};

/// What a component wrote in the recorded run, and what its behaviour writes now.
struct JudgedCurves {
    FieldCurves then{}, now{};
};

/// Gives what was recorded to the behaviour of `drive.entry` as its file is now, tick by tick, and compares what it
/// writes. Numbers are equal if they differ by at most `tolerance`. An error if the behaviour can't be loaded, if it
/// has an in-port that the drive does not have in this type, or if an act of the drive fails now. `curves` gets all
/// numbers, unless it is null.
Expected<Judgement> judge(const RecordedDrive& drive, const Project& project, const LiveOptions& options,
                          double tolerance, JudgedCurves* curves = nullptr);

}  // namespace nezumi
