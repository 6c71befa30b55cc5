// The messages that a component received and wrote in a recorded run, to test another version of its behaviour with
// them.
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
    BehaviorEntry entry;          ///< the component's name, rate, parameters and sets
    double rate = 100;            ///< [Hz] of the tick
    double physics_step = 0.005;  ///< [s]
    std::uint64_t seed = 0;       ///< of the run
    std::int64_t ticks = 0;
    std::vector<double> times{};  ///< [s] times of the ticks, if a clock gave them; empty: a tick lasts 1 / rate
    std::map<std::string, DrivePort, std::less<>> arrived{};    ///< messages at in-ports, by port name
    std::map<std::string, DrivePort, std::less<>> published{};  ///< messages of out-ports, by port name
    std::vector<std::pair<std::int64_t, Act>> acts{};           ///< acts on the component, each before this tick
    std::vector<std::string> notes{};                           ///< for the user
};

/// The behaviour with this name in a recorded system. The error lists the behaviours of the system.
Expected<const BehaviorEntry*> recorded_behavior(const SystemSpec& spec, const std::string& component);

/// Repeats a run up to the first restart or seek, and keeps the messages that this component received and wrote. An
/// error if the run can't be repeated, or the component is not in its system file.
Expected<RecordedDrive> drive_of(Replay& replay, RunningSystem& live, const std::string& component);

/// A value that a behaviour now writes differently than in the recorded run.
struct JudgedField {
    std::string name;        ///< "keeper.out.vx"
    std::int64_t ticks = 0;  ///< number of ticks in which it differs
    double largest = 0;      ///< largest difference, of numbers
    double largest_at = 0;   ///< [s] time of the largest difference
    bool operator==(const JudgedField&) const = default;
};

struct Judgement {
    std::int64_t ticks = 0;               ///< number of all ticks
    std::int64_t different = 0;           ///< number of ticks in which a value differs by more than the tolerance
    std::vector<JudgedField> fields{};    ///< the values that differ
    std::vector<DifferingValue> first{};  ///< the differing values in the first tick that differs
    double first_at = 0;                  ///< [s] time of this tick
    std::int64_t first_tick = 0;
    std::vector<std::string> lines{};  ///< lines of the behaviour that were executed in this tick, with values
    std::vector<std::string> notes{};  ///< for the user
};

/// The numbers that a component wrote in the recorded run (`then`), and those that its behaviour writes now.
struct JudgedCurves {
    FieldCurves then{}, now{};
};

/// Runs the present version of the behaviour of `drive.entry` with the recorded messages, tick by tick, and compares
/// what it writes with the recording. Numbers are equal if they differ by at most `tolerance`. An error if the
/// behaviour can't be loaded, if it has an in-port that is not in the drive or has another type there, or if an act of
/// the drive fails now. `curves` gets all numbers, unless it is null.
Expected<Judgement> judge(const RecordedDrive& drive, const Project& project, const LiveOptions& options,
                          double tolerance, JudgedCurves* curves = nullptr);

}  // namespace nezumi
