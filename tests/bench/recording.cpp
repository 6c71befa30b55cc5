// What a recording costs and how large it is, as CSV and as MCAP; and how fast behaviours are judged by it.
//
// One mouse that drives a circle, all its ports. "tick" is the CPU time of the thread that ticks, "all" that of the
// whole process, in which another thread writes. A drive that is judged is the recorded minute: its file is read, the
// run is repeated for the messages, and the behaviour gets them. With `--judge`: only that.
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/files/judged_run.hpp"
#include "bindings/cli/run/mcap_recorder.hpp"
#include "bindings/cli/run/recorder.hpp"
#include "bindings/journal/journal.hpp"
#include "tests/bench/whole_engine.hpp"

using namespace nezumi;

namespace {

constexpr std::int64_t minute = 6000;  // ticks, at 100 Hz

double process_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Cost {
    double tick = 0, all = 0;  // [s]
    std::uintmax_t bytes = 0;
};

class Mouse {
public:
    explicit Mouse(std::filesystem::path folder) : folder_(std::move(folder)) {
        std::ofstream(system_) << bench::mouse_text;
    }

    // Makes a minute of the run, with what `begin` opens for the loaded system.
    Cost run(const std::string& name, JournalSink journal,
             const std::function<std::unique_ptr<cli::RunRecording>(RunningSystem&)>& begin) const {
        LiveOptions options = cli::simulated_systems();
        options.installed = {NEZUMI_SOURCE_ROOT};
        options.budget = headless_budget;
        const auto live = bench::must(RunningSystem::load(system_, std::move(options)));
        std::unique_ptr<Journal> acts;
        if (journal) {
            acts = Journal::of_sink(std::move(journal));
            acts->begin(*live, "bench", false);
        }
        const auto recording = begin(*live);
        live->activate();
        const double before = process_seconds();
        Cost cost;
        cost.tick = bench::time_of([&] {
            for (std::int64_t tick = 0; tick < minute; ++tick) {
                live->tick();
                if (acts) acts->serve();
                if (recording == nullptr) continue;
                recording->add_rows(live->system());
                while (recording->is_behind()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
            }
            if (acts) acts->end(RunEnd::duration, "", live->when(), live->trace_hash());
            if (recording != nullptr) bench::must(recording->finish().map([] { return 0; }));
        });
        cost.all = process_seconds() - before;
        if (recording != nullptr) cost.bytes = std::filesystem::file_size(folder_ / name);
        return cost;
    }

    Cost alone() const {
        return run("", {}, [](RunningSystem&) { return nullptr; });
    }
    Cost csv() const {
        return run("run.csv", {}, [this](RunningSystem& live) {
            return std::make_unique<cli::Recorder>(
                bench::must(cli::Recorder::open((folder_ / "run.csv").string(), live.trace(), live.system(), {})));
        });
    }
    Cost mcap() const {
        auto recorder = bench::must(cli::McapRecorder::create(mcap_file()));
        cli::McapRecorder* const its = recorder.get();
        return run("run.mcap", its->journal_sink(), [&](RunningSystem& live) {
            bench::must(its->begin(live, {}, 1).map([] { return 0; }));
            return std::move(recorder);
        });
    }
    std::string mcap_file() const { return (folder_ / "run.mcap").string(); }

private:
    std::filesystem::path folder_;
    std::filesystem::path system_ = folder_ / "mouse.lua";
};

void measure_recording(const Mouse& mouse) {
    constexpr int rounds = 11;
    struct Row {
        const char* name;
        Cost (Mouse::*run)() const;
        std::vector<double> tick{}, all{};
        std::uintmax_t bytes = 0;
    };
    std::vector<Row> rows{{"none", &Mouse::alone}, {"CSV", &Mouse::csv}, {"MCAP", &Mouse::mcap}};
    for (int round = 0; round < rounds; ++round) {
        for (Row& row : rows) {
            const Cost cost = (mouse.*row.run)();
            row.tick.push_back(cost.tick);
            row.all.push_back(cost.all);
            row.bytes = cost.bytes;
        }
    }
    std::puts("  recording  tick [us]   all [us]  KB/minute");
    for (const Row& row : rows) {
        std::printf("  %-9s %10.1f %10.1f %10.0f\n", row.name, bench::median(row.tick) * 1e6 / minute,
                    bench::median(row.all) * 1e6 / minute, static_cast<double>(row.bytes) / 1000);
    }
    std::fflush(stdout);
}

void measure_judging(const Mouse& mouse) {
    mouse.mcap();
    const JudgeRequest request{.behavior = NEZUMI_SOURCE_ROOT "/behaviors/robot_controller.lua",
                               .run = mouse.mcap_file()};
    std::vector<double> read, judge;
    for (int round = 0; round < 11; ++round) {
        std::unique_ptr<cli::JudgedRun> run;
        read.push_back(bench::time_of(
            [&] { run = std::make_unique<cli::JudgedRun>(bench::must(cli::JudgedRun::read(request))); }));
        judge.push_back(bench::time_of([&] {
            if (bench::must(run->judge(request.tolerance, [](const LogLine&) {})).different == 0) return;
            std::puts("  the behaviour writes something else than in the drive: the figures mean nothing");
        }));
    }
    const double again = bench::median(judge), whole = bench::median(read) + again;
    std::printf(
        "\n  a drive of a minute is judged in %.0f ms, %.1f drives a second; again after a save in %.0f ms (limit "
        "1000: %s)\n",
        whole * 1e3, 1 / whole, again * 1e3, bench::verdict(again, 1));
}

}  // namespace

int main(int argc, char** argv) {
    bench::print_header("recordings", "one mouse that drives a circle for a minute at 100 Hz, all ports");
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("nezumi_recording_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    const Mouse mouse(folder);
    const bool judging_alone = argc == 2 && std::string_view(argv[1]) == "--judge";
    if (!judging_alone) measure_recording(mouse);
    measure_judging(mouse);
    std::filesystem::remove_all(folder);
}
