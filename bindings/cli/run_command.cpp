// `nezumi run`: a system file, simulated until its end or Ctrl-C.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "bindings/cli/commands.hpp"
#include "bindings/cli/environment.hpp"
#include "bindings/cli/named_files.hpp"
#include "bindings/cli/output_files.hpp"
#include "bindings/cli/picture.hpp"
#include "bindings/cli/real_time.hpp"
#include "bindings/cli/recorder.hpp"
#include "bindings/cli/run_console.hpp"
#include "bindings/cli/run_devices.hpp"
#include "bindings/cli/run_hardware.hpp"
#include "bindings/cli/run_journal.hpp"
#include "bindings/cli/run_options.hpp"
#include "bindings/cli/run_rtm.hpp"
#include "bindings/cli/run_web.hpp"
#include "bindings/cli/screen.hpp"
#include "bindings/cli/status_line.hpp"
#include "bindings/cli/stop_signals.hpp"
#include "bindings/cli/system_error.hpp"
#include "bindings/cli/trajectories.hpp"
#include "bindings/console/put_text.hpp"
#include "bindings/dds/network_maker.hpp"
#include "bindings/embed/simulation.hpp"
#include "engine/base/visible.hpp"
#include "engine/live/problems.hpp"
#include "engine/live/robot_buttons.hpp"
#include "engine/live/run_loop.hpp"

namespace nezumi::cli {
namespace {

// Robots that brake longer than this [s] of simulated time are pushed: nobody waits for them.
constexpr double longest_braking = 1;

bool all_stand(const System& system) {
    for (const Robot* robot : system.robots()) {
        if (robot->guard().current() != Velocity2D{}) return false;
    }
    return true;
}

// Deactivates everything and lets the robots brake. Who sends SIGTERM wants an end now: real ones stand with the next
// tick, which does not wait for its time.
void stop(RunLoop& loop, int signal) {
    const bool at_once = signal == SIGTERM;
    if (at_once) loop.live().halt();
    loop.live().end();
    const System& system = loop.live().system();
    if (at_once || !loop.is_hardware()) loop.set_speed(as_fast_as_possible);
    const double end = system.now().seconds + longest_braking;
    do {
        loop.tick();
    } while (!all_stand(system) && system.now().seconds < end);
}

std::string summary(const RunLoop& loop, std::chrono::duration<double> wall) {
    const double simulated = loop.advanced();
    std::string text = fmt::format("{:.2f} s simulated in {:.2f} s", simulated, wall.count());
    if (wall.count() > 0) text += fmt::format(", {:.2f} times real time", simulated / wall.count());
    const Lateness lateness = loop.lateness();
    if (lateness.ticks() > 0) text += fmt::format("; ticks began late by {}", to_text(lateness));
    if (lateness.late() > 0) text += fmt::format("; late ticks: {}", lateness.late());
    if (lateness.skipped() > 0) text += fmt::format("; ticks left out: {}", lateness.skipped());
    return text;
}

// One run of `nezumi run`, from the options to the exit status, or to what kept it from running.
class Run {
public:
    explicit Run(RunOptions options)
        : options_(std::move(options)),
          prompt_(!options_.headless && has_terminal()),
          screen_(!options_.headless && !prompt_ && isatty(STDERR_FILENO) != 0) {}

    Expected<int> operator()() {
        if (auto ok = need_simulation({{"run without --hw", !options_.hardware},
                                       {"--twin", options_.hardware && options_.hardware->twins},
                                       {"--picture", !options_.picture.empty()}});
            !ok)
            return Unexpected(ok.error());
        // A replay reads no other file, and knows its system by name.
        auto file = find_system_file(options_.file);
        if (!file && options_.replay.empty()) return Unexpected(file.error());
        if (file) options_.file = file->string();
        if (!options_.values.file.empty()) {
            auto values = find_system_file(options_.values.file);
            if (!values) return Unexpected(values.error());
            options_.values.file = values->string();
        }
        if (options_.hardware) {
            auto devices = RunDevices::open(*options_.hardware);
            if (!devices) return Unexpected(devices.error());
            devices_.emplace(std::move(*devices));
        }
        auto live = journal_.load(options_, live_options());
        if (!live) return Unexpected(explain_system_error(live.error()));
        live_ = std::move(*live);
        StopSignals stop_signals;
        live_->trace().remember_ports();
        if (auto ready = prepare_files(); !ready) return Unexpected(ready.error());
        stop_signals.at_second([this] {
            if (recorder_) recorder_->end_here("the run was ended at once");
        });

        live_->activate();
        loop_.emplace(*live_, RunLoop::Options{.speed = options_.speed, .problems = &problems_});
        RunLoop& loop = *loop_;
        loop.end_when(stop_signals.received());
        loop.end_at(options_.duration);
        journal_.follow(loop);
        StartButtons start_buttons(loop, [this](const std::string& text) { say(text); });
        ShutdownButtons shutdown_buttons(loop, [this](const std::string& text) { say(text); });
        for (const std::string& note : journal_.notes()) screen_.say(note);
        StatusLine status_line(loop, screen_);
        if (screen_.is_live()) loop.add(status_line);
        if (auto open = open_rtm(); !open) return Unexpected(open.error());
        if (auto open = options_.replay.empty() ? open_console() : Expected<void>(); !open)
            return Unexpected(open.error());
        if (recorder_ || !options_.picture.empty()) loop.after_tick([this, &loop] { keep_trace(loop); });
        if (devices_) devices_->follow(loop, [this](const std::string& line) { say(line); });
        if (options_.real_time) {
            real_time_.emplace();
            say(real_time_->told());
        }

        const auto begin = Pacer::Clock::now();
        loop.run();
        const std::string how = summary(loop, Pacer::Clock::now() - begin);
        if (devices_) devices_->end();
        journal_.stop();
        if (journal_.error()) return give_up(*journal_.error());
        if (const auto& fatal = live_->system().fatal_error()) return give_up(*fatal);

        // A run of a given length shows the world as it is then, whether --duration or commands said how long it is;
        // one that was ended shows it when the robots stand.
        const bool of_given_length = journal_.is_of_given_length(
            !loop.interrupted() && (options_.batch || live_->system().now().seconds >= options_.duration - 1e-9));
        if (of_given_length) take_results();
        stop(loop, stop_signals.received());
        shutdown_buttons.finish();
        if (const auto& fatal = live_->system().fatal_error()) return give_up(*fatal);
        if (!of_given_length) take_results();
        if (auto told = journal_.finish(of_given_length, hash_); !told) return give_up(told.error());
        rtm_.reset();
        web_.reset();
        if (console_) console_->close();
        return finish(how);
    }

private:
    LiveOptions live_options() {
        LiveOptions live = simulated_systems();
        if (!options_.sounds.empty()) keep_sounds(live, options_.sounds);
        live.build = {.seed = options_.seed.value_or(0),
                      .seed_wins = options_.seed.has_value(),
                      .threads = options_.threads,
                      .out_of_time_is_fatal = options_.headless,
                      .log = [this](const LogLine& line) {
                          problems_.take(line);
                          if (web_) web_->log(line);
                          if (!console_ || !console_->log(line)) screen_.log(line);
                      }};
        live.values = options_.values;
        live.budget = options_.headless ? headless_budget : paced_budget;
        live.watch = !options_.headless;
        // What came over the network is in the journal: its replay is alone.
        if (options_.replay.empty()) live.network = dds::make_networks(domains_, NEZUMI_VERSION);
        if (devices_) use_hardware(live, *options_.hardware, devices_->roots());
        live.print = [this](std::string_view line) { say(std::string(line)); };
        return live;
    }

    void say(const std::string& line) {
        if (web_) web_->say(line);
        if (!console_ || !console_->say(line)) screen_.say(line);
    }

    Expected<void> open_console() {
        console_.emplace(*loop_, std::filesystem::path(options_.file).stem().string());
        loop_->add(*console_);
        console_->server().ask_peers_by(
            [this](const PeerWish& wish) { return rtm_ ? rtm_->ask(wish) : refused_peers(); });
        loop_->after_tick([this] { console_->after_tick(); });
        if (options_.batch) loop_->end_waits_while([this] { return console_->batch_works(); });
        // A run that nobody can attach to is better than none.
        if (auto ok = console_->listen(); !ok) screen_.say("nobody can attach: " + ok.error().message);
        if (options_.batch) return console_->open_batch();
        const std::string address = open_web();
        if (prompt_) return console_->open_prompt(address);
        if (!address.empty()) screen_.say(address);
        return {};
    }

    // Returns what is to be said of the page. A run without one is better than none.
    std::string open_web() {
        if (!options_.web) return "";
        auto web = RunWeb::open(*loop_, *console_, *options_.web);
        if (!web) return "no page for browsers: " + web.error().message;
        web_ = std::move(*web);
        loop_->add(*web_);
        if (isatty(STDERR_FILENO) != 0) put_text(stderr, web_->picture());
        return web_->where();
    }

    // A replay has what RTCs did in its journal.
    Expected<void> open_rtm() {
        if (!live_->spec().rtm || !options_.replay.empty()) return {};
        auto rtm = RunRtm::open(*loop_, live_->options().build.log);
        if (!rtm) return Unexpected(rtm.error());
        rtm_ = std::move(*rtm);
        loop_->add(*rtm_);
        return {};
    }

    Expected<void> prepare_files() {
        if (!options_.picture.empty()) {
            if (auto ok = check_can_write(options_.picture); !ok) return ok;
        }
        if (options_.record.empty()) return {};
        auto recorder = Recorder::open(options_.record, live_->trace(), live_->system(), options_.ports);
        if (!recorder) return Unexpected(recorder.error());
        recorder_.emplace(std::move(*recorder));
        return {};
    }

    void keep_trace(RunLoop& loop) {
        if (recorder_) {
            recorder_->add_rows(live_->system());
            if (recorder_->error()) loop.quit();
        }
        if (options_.picture.empty()) return;
        if (starts_ != live_->starts()) trajectories_.clear();
        starts_ = live_->starts();
        trajectories_.add(live_->system(), live_->trace());
    }

    void take_results() {
        if (recorder_) recorder_->seal();
        hash_ = live_->trace_hash();
        if (!options_.picture.empty())
            picture_ = look_at(*live_, trajectories_, std::filesystem::path(options_.file).stem().string());
    }

    // The run is none: no file is left that could be taken for its result. The rows that are whole stay, with a note.
    Expected<int> give_up(const Error& error) {
        std::string why = visible(describe(error));
        std::replace(why.begin(), why.end(), '\n', ' ');
        if (recorder_) recorder_->end_here(why);
        journal_.give_up(describe(error));
        if (!recorder_ || recorder_->told_of_older().empty()) return Unexpected(error);
        Error told = error;
        told.message += fmt::format(" (the recording ends there{})", recorder_->told_of_older());
        return Unexpected(std::move(told));
    }

    // Whether commands of --batch have not had what they were to have.
    bool tell_cut_off() {
        if (!options_.batch || !(loop_->interrupted() || loop_->came_to_end())) return false;
        const int line = console_->unfinished_line();
        const std::string why = loop_->interrupted()
                                    ? "a signal ended the run"
                                    : fmt::format("--duration ended the run at {:g} s", options_.duration);
        if (line > 0) screen_.say(fmt::format("line {}: not run to its end: {}", line, why));
        return line > 0 || loop_->interrupted();
    }

    Expected<int> finish(const std::string& how) {
        real_time_.reset();
        if (recorder_) {
            if (auto ok = recorder_->finish(); !ok) return Unexpected(ok.error());
        }
        if (picture_) {
            if (auto ok = draw_picture(std::move(*picture_), options_.picture); !ok) return Unexpected(ok.error());
        }
        // What --batch says is the same each time, and how long it took is not.
        if (!options_.batch) screen_.say(how);
        int status = (!console_ || console_->all_well()) && !tell_cut_off() ? exit_done : exit_failed;
        if (devices_ && !devices_->finish()) status = exit_failed;
        for (const auto& component : live_->system().components()) {
            if (component->state() != LifeState::error) continue;
            screen_.say(fmt::format("nezumi: {} ended in ERROR: {}", component->name(),
                                    visible_message(describe(component->last_error()))));
            status = exit_failed;
        }
        if (options_.trace_hash) put_text(stdout, fmt::format("trace hash: {:016x}\n", hash_));
        return status;
    }

    RunOptions options_;
    bool prompt_;
    Screen screen_;  // before all that speaks through it
    Problems problems_;
    std::optional<RunDevices> devices_;
    RunJournal journal_;  // its files outlive the system
    dds::Domains domains_;
    std::unique_ptr<RunningSystem> live_;
    std::optional<Recorder> recorder_;
    Trajectories trajectories_;
    int starts_ = 0;
    std::optional<PictureOf> picture_;
    std::uint64_t hash_ = 0;
    std::optional<RunLoop> loop_;
    std::optional<RunConsole> console_;
    std::unique_ptr<RunWeb> web_;  // before the console that it relays goes
    std::unique_ptr<RunRtm> rtm_;
    std::optional<RealTime> real_time_;
};

}  // namespace

SubCommand run_command() {
    auto words = std::make_shared<RunWords>();
    return {.name = "run",
            .help = "Run a system file: simulate it, and reload scripts when they are saved",
            .options = run_options(*words),
            .run =
                [words] {
                    const auto ended =
                        read_run_options(*words).and_then([](RunOptions options) { return Run(std::move(options))(); });
                    return ended ? *ended : refuse(ended.error());  // when the screen is free again
                },
            .footer =
                "Ctrl-C ends a run in good order: behaviours deactivated, robots stopped, files complete; a "
                "second one at once.\nExit status: 0 the run came to its end, 1 it did and a component was in "
                "ERROR then or a command of --batch had failed or was cut off, 2 it could not be run."};
}

}  // namespace nezumi::cli
