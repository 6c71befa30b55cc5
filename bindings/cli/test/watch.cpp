// Compares the times of files, because runs are forked processes, which do not inherit a watching thread.
#include "bindings/cli/test/watch.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/base/status.hpp"
#include "bindings/cli/base/stop_signals.hpp"
#include "bindings/scenario/test_session.hpp"

namespace nezumi::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds look_period{30};
constexpr int periods_of_folders = 10;  // folders are read less often than times of files

// A scenario file may require the other Lua files of its folder.
std::set<std::string> files_beside(const fs::path& scenario) {
    std::set<std::string> files{scenario.string()};
    std::error_code none;
    for (const auto& each :
         fs::directory_iterator(scenario.parent_path().empty() ? "." : scenario.parent_path(), none)) {
        const std::string name = each.path().filename().string();
        if (name.ends_with(".lua") && !name.ends_with("_test.lua"))
            files.insert((scenario.parent_path() / each.path().filename()).string());
    }
    return files;
}

class Watch {
public:
    explicit Watch(const TestSessionOptions& options) : options_(options) {}

    // The runs of a plan that are new, or have read one of these files; those that failed come first.
    TestPlan touched(TestPlan plan, const std::set<std::string>& saved) const {
        std::erase_if(plan.runs, [&](const PlannedRun& run) {
            const auto known = runs_.find(key_of(plan, run));
            if (known == runs_.end()) return false;
            return std::none_of(saved.begin(), saved.end(),
                                [&](const std::string& file) { return known->second.reads.contains(file); });
        });
        std::stable_partition(plan.runs.begin(), plan.runs.end(), [&](const PlannedRun& run) {
            const auto known = runs_.find(key_of(plan, run));
            return known != runs_.end() && known->second.failed;
        });
        return plan;
    }

    SessionEnd run(const TestPlan& plan, Reporter& reporter) {
        SessionEnd end = run_tests(plan, options_, reporter);
        for (const PlannedRun& run : plan.runs) {
            const PlannedFile& file = plan.files[run.file];
            const auto report = std::find_if(end.reports.begin(), end.reports.end(), [&](const RunReport& each) {
                return each.name == run.name && each.file == file.scenarios[run.scenario].place.file;
            });
            if (report == end.reports.end()) continue;
            Known& known = runs_[key_of(plan, run)];
            known.failed = report->result.outcome != RunOutcome::passed;
            known.reads = files_beside(file.path);
            known.reads.insert(report->result.reads.begin(), report->result.reads.end());
        }
        return end;
    }

    // Stores the times of all files that runs have read or searched for, and of the scenario files.
    void look(const TestPlan& plan) {
        times_.clear();
        const auto add = [&](const std::string& file) { times_.emplace(file, time_of(file)); };
        for (const PlannedFile& file : plan.files) {
            for (const std::string& beside : files_beside(file.path)) add(beside);
            for (const std::string& module : file.looked_for) add(module);
        }
        for (const auto& [key, known] : runs_) {
            for (const std::string& file : known.reads) add(file);
        }
    }
    // Stores the times of the same files again.
    void look_again() {
        for (auto& [file, time] : times_) time = time_of(file);
    }

    // The files that were saved since the times were stored. A missing file does not count: it is about to be written
    // again.
    std::set<std::string> saved() const {
        std::set<std::string> files;
        for (const auto& [file, time] : times_) {
            const auto now = time_of(file);
            if (now && now != time) files.insert(file);
        }
        return files;
    }

    // The scenario files that are new since the last call.
    std::set<std::string> added(const std::vector<fs::path>& paths) {
        const auto found = find_scenario_files(paths);
        if (!found) return {};
        std::set<std::string> files, present;
        for (const fs::path& file : *found) {
            present.insert(file.string());
            if (!scenarios_.contains(file.string())) files.insert(file.string());
        }
        scenarios_ = std::move(present);
        return files;
    }

private:
    struct Known {
        bool failed = false;
        std::set<std::string> reads;
    };

    static std::string key_of(const TestPlan& plan, const PlannedRun& run) {
        return plan.files[run.file].shown + "\n" + run.name;
    }
    static std::optional<std::pair<fs::file_time_type, std::uintmax_t>> time_of(const std::string& file) {
        std::error_code problem;
        const auto time = fs::last_write_time(file, problem);
        const auto size = problem ? 0 : fs::file_size(file, problem);
        return problem ? std::nullopt : std::optional(std::pair(time, size));
    }

    const TestSessionOptions& options_;
    std::map<std::string, Known> runs_;
    std::map<std::string, std::optional<std::pair<fs::file_time_type, std::uintmax_t>>> times_;
    std::set<std::string> scenarios_;
};

}  // namespace

int watch_tests(const std::vector<fs::path>& paths, const std::function<Expected<TestPlan>()>& make_plan,
                const TestSessionOptions& options, const std::function<std::unique_ptr<Reporter>()>& make_reporter) {
    Watch watch(options);
    std::set<std::string> saved;
    int status = exit_done;
    for (;;) {
        watch.added(paths);  // stores the present scenario files, before they are read
        auto plan = make_plan();
        if (!plan && saved.empty()) return refuse(plan.error());
        if (!plan) {
            static_cast<void>(refuse(plan.error()));
            watch.look_again();
        } else {
            const TestPlan whole = *plan;
            TestPlan touched = watch.touched(std::move(*plan), saved);
            // Before the runs, so that files saved during the runs are found.
            watch.look(whole);
            const auto reporter = make_reporter();
            const SessionEnd end = watch.run(touched, *reporter);
            if (end.interrupted) return refuse("interrupted: not all scenarios have run");
            status = end.status();
            const std::set<std::string> meanwhile = watch.saved();
            watch.look(whole);
            std::fflush(stdout);
            saved = meanwhile;
            if (!saved.empty()) continue;
        }
        const StopSignals signals;
        for (int periods = 1; saved = watch.saved(), saved.empty(); ++periods) {
            if (signals.received() != 0) return status;
            std::this_thread::sleep_for(look_period);
            if (periods % periods_of_folders != 0) continue;
            if (saved = watch.added(paths); !saved.empty()) break;
        }
    }
}

}  // namespace nezumi::cli
