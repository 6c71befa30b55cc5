// Checks a pupil's work by the scenarios of its exercise, in a copy.
#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "bindings/web/classroom/exercises.hpp"
#include "bindings/web/classroom/seat.hpp"

namespace nezumi::web {

/// The beginning of a command line that runs a command of nezumi with access only to `folder` and `devices`; append the
/// command to it.
std::vector<std::string> confined_words(const std::string& program, const std::filesystem::path& folder, bool trust,
                                        const std::vector<std::filesystem::path>& devices = {});

struct WorkToCheck {
    Exercise exercise{};
    std::filesystem::path work{};     ///< the pupil's project; it is not changed
    std::filesystem::path scratch{};  ///< a folder for the copy, emptied before and removed after
    std::string program{};            ///< path of nezumi
    bool trust = false;               ///< as in `ClassOptions`
};

/// Runs the shown and the hidden scenarios of the exercise, not the pupil's copies of them. The results are in the
/// order of the files. Returns an error of one line if they could not be run.
Expected<std::vector<CheckedScenario>> check_work(const WorkToCheck& wanted, const std::atomic<bool>& give_up);

/// Reads the scenarios from the output of `nezumi test --tap`. `hidden` is the folder with the exercise's hidden files.
std::vector<CheckedScenario> read_tap(const std::string& text, const std::filesystem::path& hidden);

/// The results of one pupil, for a table and for continuous integration (JUnit).
struct PupilResult {
    int number = 0;
    std::string name{}, exercise{}, problem{}, mark{}, comment{};
    std::vector<CheckedScenario> checked{};
};
/// Writes results.csv and results.xml into `folder`, which is made if missing.
Expected<void> write_results(const std::filesystem::path& folder, const std::vector<PupilResult>& results);
/// Copies a pupil's work into a folder below `folder` that has the pupil's number as its name.
Expected<void> collect_work(const Pupils& pupils, const Pupil& pupil, const std::filesystem::path& folder);
/// Collects the work of all pupils of the class in `folder` into `to`, and checks it by the exercises.
Expected<void> collect_class(const std::filesystem::path& folder, const std::vector<Exercise>& exercises,
                             const std::filesystem::path& to, const std::string& program, bool trust);
std::string results_csv(const std::vector<PupilResult>& results);
std::string results_junit(const std::vector<PupilResult>& results);

}  // namespace nezumi::web
