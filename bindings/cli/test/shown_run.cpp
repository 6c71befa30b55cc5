// The scenario decides how many ticks there are; the loop decides when each of them is due.
#include "bindings/cli/test/shown_run.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/base/status.hpp"
#include "bindings/cli/base/stop_signals.hpp"
#include "bindings/cli/run/web.hpp"
#include "bindings/console/put_text.hpp"
#include "bindings/scenario/spectator.hpp"
#include "engine/base/visible.hpp"
#include "engine/live/run_loop.hpp"

namespace nezumi::cli {
namespace {

using Clock = Pacer::Clock;

constexpr std::chrono::seconds longest_arrival{30};  // of the first browser
constexpr std::chrono::seconds longest_absence{10};  // a page that is reloaded comes back within this time

// The page of a run, from its first tick.
class ShownRun final : public Spectator {
public:
    ShownRun(Web web, const volatile std::sig_atomic_t& ends) : web_options_(std::move(web)), ends_(ends) {
        web_options_.only_shows = "a scenario that is watched can't be changed";
    }

    void tick(RunningSystem& live) override {
        if (!loop_) open(live);
        if (!is_left() && loop_->next_tick()) return;
        live.tick();  // no browser shows the run: as fast as possible
    }

    void log(const LogLine& line) override {
        if (web_) web_->log(line);
    }

    void ended(const RunResult& result) override {
        if (!web_) return;
        const bool passed = result.outcome == RunOutcome::passed;
        web_->show_end(passed ? fmt::format("passed after {:.2f} s", result.seconds) : describe(result.error), passed);
        wait_while([&] {
            loop_->pause();
            return !is_left();
        });
        web_.reset();
        console_.reset();
        loop_.reset();
    }

private:
    void open(RunningSystem& live) {
        loop_.emplace(live, RunLoop::Options{});
        loop_->end_when(ends_);
        console_.emplace(*loop_, live.file().stem().string());
        auto web = RunWeb::open(*loop_, *console_, web_options_, {}, {});
        if (!web) {
            put_text(stderr, visible("no page for browsers: " + web.error().message) + "\n");
            return;
        }
        web_ = std::move(*web);
        loop_->add(*console_);
        loop_->add(*web_);
        if (!web_options_.on_input) put_text(stderr, visible(web_->where()) + "\n");
        seen_ = Clock::now() + (longest_arrival - longest_absence);
        wait_while([&] { return !web_->is_watched() && !is_left(); });
        loop_->set_speed(loop_->speed());  // ticks are due from now on
    }

    bool is_left() {
        if (!web_ || ends_ != 0) return true;
        const auto now = Clock::now();
        if (web_->is_watched()) seen_ = now;
        return now - seen_ > longest_absence;
    }

    // Serves the page while the condition holds.
    template <class Condition>
    void wait_while(const Condition& holds) {
        while (holds()) {
            web_->serve(Clock::now() + std::chrono::milliseconds(10));
            console_->serve(Clock::now() + std::chrono::milliseconds(10));
            std::vector<int> files;
            web_->add_files(files);
            std::vector<pollfd> polled;
            polled.reserve(files.size());
            for (const int file : files) polled.push_back({.fd = file, .events = POLLIN, .revents = 0});
            poll(polled.data(), polled.size(), 20);
        }
    }

    Web web_options_;
    const volatile std::sig_atomic_t& ends_;
    std::optional<RunLoop> loop_;
    std::optional<RunConsole> console_;
    std::unique_ptr<RunWeb> web_;
    Clock::time_point seen_{};
};

}  // namespace

int show_run(const TestPlan& plan, TestSessionOptions options, const Web& web, Reporter& reporter) {
    for (const PlannedFile& file : plan.files) {
        if (!file.errors.empty()) return refuse(file.errors.front());
    }
    if (plan.runs.size() != 1)
        return refuse(fmt::format(
            "--show can show only one run, and these are {} runs: choose one by --filter (--list shows their names)",
            plan.runs.size()));
    const StopSignals signals;
    ShownRun shown(web, signals.received());
    options.spectator = &shown;
    const PlannedRun& run = plan.runs.front();
    reporter.begin(1);
    const RunReport report = report_of(plan, run, run_planned(plan, run, options, true), options);
    reporter.add(report);
    const bool passed = report.result.outcome == RunOutcome::passed;
    const bool failed = report.result.outcome == RunOutcome::failed;
    reporter.end({.passed = passed ? 1U : 0U,
                  .failed = failed ? 1U : 0U,
                  .could_not_run = passed || failed ? 0U : 1U,
                  .seconds = report.result.seconds,
                  .wall_seconds = report.result.wall_seconds,
                  .seed = options.seed,
                  .jobs = 1});
    return passed ? exit_done : failed ? exit_failed : exit_could_not_run;
}

}  // namespace nezumi::cli
