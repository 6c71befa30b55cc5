// Opens the parts of a run in order, and ends all of them even if one of them blocks.
#include "bindings/cli/run/run.hpp"

#include <fmt/format.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/base/standard_files.hpp"
#include "bindings/cli/base/status.hpp"
#include "bindings/cli/base/stop_signals.hpp"
#include "bindings/cli/base/version.hpp"
#include "bindings/cli/files/lua_kind.hpp"
#include "bindings/cli/files/named_files.hpp"
#include "bindings/cli/files/output_files.hpp"
#include "bindings/cli/run/console.hpp"
#include "bindings/cli/run/devices.hpp"
#include "bindings/cli/run/hardware.hpp"
#include "bindings/cli/run/journal.hpp"
#include "bindings/cli/run/profile.hpp"
#include "bindings/cli/run/real_time.hpp"
#include "bindings/cli/run/results.hpp"
#include "bindings/cli/run/rtm.hpp"
#include "bindings/cli/run/screen.hpp"
#include "bindings/cli/run/status_line.hpp"
#include "bindings/cli/run/web.hpp"
#include "bindings/console/put_text.hpp"
#include "bindings/dds/network_maker.hpp"
#include "bindings/embed/simulation.hpp"
#include "bindings/openrtm/rtm_word.hpp"
#include "bindings/push/interrupted.hpp"
#include "engine/base/visible.hpp"
#include "engine/live/problems.hpp"
#include "engine/live/robot_buttons.hpp"
#include "engine/live/run_loop.hpp"
#include "hw/guard/guard.hpp"

namespace nezumi::cli {
namespace {

// Robots that brake longer than this [s] of simulated time are pushed by something: the run does not wait for them.
constexpr double longest_braking = 1;

// How long standard output waits for standard error, so that a terminal shows both in order.
constexpr std::chrono::milliseconds usual_flush{500};

bool all_stand(const System& system) {
    for (const Robot* robot : system.robots()) {
        if (robot->guard().current() != Velocity2D{}) return false;
    }
    return true;
}

// Deactivates everything and lets the robots brake. SIGTERM requires an immediate end: real robots stop in the next
// tick, which begins at once.
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

// One run of `nezumi run`, from the options to the exit status, or to the error that prevented it.
class Run {
public:
    explicit Run(RunOptions options)
        : options_(std::move(options)),
          prompt_(!options_.headless && has_terminal()),
          screen_(!options_.headless && !prompt_ && isatty(STDERR_FILENO) != 0) {
        if (prompt_) tcgetattr(STDIN_FILENO, &terminal_before_);
    }

    ~Run() {
        // Everything that may hang is ended here, while signals are still watched.
        doing_ = "devices and components of other programs";
        rtm_.reset();
        web_.reset();
        console_.reset();
        loop_.reset();
        live_.reset();
        if (devices_) devices_->close([this](const std::string& line) { screen_.say(line); });
        give_up_files();  // of a run that failed; after a complete run this has no effect
        doing_ = "standard error";
    }
    Run(const Run&) = delete;
    Run& operator=(const Run&) = delete;

    /// Returns the exit status. If the run was not possible, its error has already been printed.
    int operator()() {
        const auto ended = run();
        if (ended) return *ended;
        screen_.show(refusal(ended.error()));
        return exit_could_not_run;
    }

private:
    Expected<int> run() {
        if (auto ok = need_simulation({{"run without --hw", !options_.hardware},
                                       {"--twin", options_.hardware && options_.hardware->twins},
                                       {"--picture", !options_.picture.empty()}});
            !ok)
            return Unexpected(ok.error());
        // A replay reads no other file: the system file that is given with it need not exist.
        if (options_.replay.empty() || !options_.file.empty()) {
            if (auto whole = push::finish_interrupted_push(options_.file); !whole) return Unexpected(whole.error());
            auto file = find_system_file(options_.file);
            if (!file && options_.replay.empty()) return Unexpected(file.error());
            if (file) options_.file = file->string();
        }
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
        if (auto ready = results_.prepare(options_); !ready) return Unexpected(ready.error());
        if (!options_.profile.empty()) {
            if (auto ok = check_can_write(options_.profile); !ok) return Unexpected(ok.error());
            profile_.emplace(options_.profile);
        }
        auto live = journal_.load(options_, live_options(), results_.journal_sink());
        if (!live) return Unexpected(explain_system_error(live.error()));
        live_ = std::move(*live);
        if (options_.file.empty()) options_.file = live_->spec().file;
        signals_.emplace();
        if (options_.history) {
            const double samples = *options_.history * 60 * live_->system().settings().rate;
            live_->trace().keep(std::max(static_cast<std::size_t>(samples), Series::usual_samples));
        }
        live_->trace().remember_ports();
        if (options_.web) live_->remember_run();  // for the page's time line
        if (auto open = results_.open(options_, *live_); !open) return Unexpected(open.error());
        signals_->watch_end({.give_up = [this] { give_up_files(); },
                             .at_once = [this] { end_at_once(); },
                             .held = [this] { return held(); }});

        live_->activate();
        if (options_.stopped) [[maybe_unused]]
            const auto stopped = live_->act(Stop{}, {});
        if (options_.opens_replay) {
            if (auto there = journal_.go_to_end(signals_->received()); !there) return Unexpected(there.error());
        }
        loop_.emplace(*live_, RunLoop::Options{.speed = options_.speed, .problems = &problems_});
        RunLoop& loop = *loop_;
        loop.end_when(signals_->received());
        loop.end_at(options_.duration);
        loop.wait_while([this] { return is_behind(); });
        journal_.follow(loop);
        if (options_.opens_replay) loop.pause();
        StartButtons start_buttons(loop, [this](const std::string& text) { say(text); });
        ShutdownButtons shutdown_buttons(loop, [this](const std::string& text) { say(text); });
        for (const std::string& note : journal_.notes()) screen_.say(note);
        StatusLine status_line(loop, screen_);
        if (screen_.is_live()) loop.add(status_line);
        if (auto open = open_rtm(); !open) return Unexpected(open.error());
        if (auto open = open_console(); !open) return Unexpected(open.error());
        tell_undriven();
        results_.follow(loop);
        if (profile_) profile_->follow(loop);
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

        // The results of a run whose length is given by --duration or by commands are those of its last tick. The
        // results of an interrupted run are those after the robots have braked.
        const bool of_given_length = journal_.is_of_given_length(
            !loop.interrupted() && (options_.batch || live_->system().now().seconds >= options_.duration - 1e-9));
        if (of_given_length) results_.take(name_of_system());
        stop(loop, signals_->received());
        shutdown_buttons.finish();
        if (const auto& fatal = live_->system().fatal_error()) return give_up(*fatal);
        if (!of_given_length) results_.take(name_of_system());
        // Files first: a console that does not read its output must not delay them.
        real_time_.reset();
        doing_ = "results to be written";
        if (auto told = journal_.finish(of_given_length, results_.hash()); !told) return give_up(told.error());
        if (profile_) {
            auto costs = profile_->finish(*live_);
            if (!costs) return Unexpected(costs.error());
            costs_ = std::move(*costs);
        }
        const auto written = results_.write();
        results_are_written_ = true;
        doing_ = "components of other programs";
        rtm_.reset();
        doing_ = "consoles";
        web_.reset();
        if (console_) console_->close();
        if (!written) return Unexpected(written.error());
        return finish(how);
    }

    LiveOptions live_options() {
        LiveOptions live = simulated_systems();
        if (!options_.sounds.empty()) keep_sounds(live, options_.sounds);
        live.build = {.seed = options_.seed.value_or(usual_seed),
                      .seed_wins = options_.seed.has_value(),
                      .threads = options_.threads,
                      .out_of_time_is_fatal = options_.headless,
                      .keep_going = options_.keep_going,
                      .log = [this](const LogLine& line) {
                          problems_.take(line);
                          results_.log(line);
                          if (web_) web_->log(line);
                          if (!console_ || !console_->log(line)) screen_.log(line);
                      }};
        live.values = options_.values;
        live.budget = options_.headless ? headless_budget : paced_budget;
        live.watch = !options_.headless;
        // A replay uses no network: the received messages are in the journal.
        if (options_.replay.empty()) live.network = dds::make_networks(domains_, version());
        if (devices_) use_hardware(live, *options_.hardware, devices_->roots());
        live.print = [this](std::string_view line) { say(std::string(line)); };
        return live;
    }

    // Reports robots that can't move because nothing is connected to their velocity port.
    void tell_undriven() {
        if (options_.batch) return;
        for (const Robot* robot : live_->system().robots()) {
            if (robot->is_twin()) continue;
            for (const auto& port : robot->in_ports()) {
                if (port->type() == message_of<Velocity2D>() && !port->connected())
                    screen_.say(
                        fmt::format("robot '{0}': nothing is connected to its {1}: connect(\"...\", \"{0}.{1}\")",
                                    robot->name(), port->name()));
            }
        }
    }

    std::string name_of_system() const { return std::filesystem::path(options_.file).stem().string(); }

    void say(const std::string& line) {
        if (web_) web_->say(line);
        if (!console_ || !console_->say(line)) screen_.say(line);
    }

    Expected<void> open_console() {
        console_.emplace(*loop_, name_of_system());
        loop_->add(*console_);
        console_->server().ask_peers_by(peer_asker());
        loop_->after_tick([this] { console_->after_tick(); });
        if (options_.batch) loop_->end_waits_while([this] { return console_->is_batch_running(); });
        // An error here does not end the run.
        if (auto ok = console_->listen(); !ok) screen_.say("no console can attach: " + ok.error().message);
        if (options_.batch) return console_->open_batch();
        const std::string page = open_web();
        if (prompt_) return console_->open_prompt(page);
        if (!page.empty()) screen_.show(page + "\n");
        return {};
    }

    // Opens the page, and returns the message about it; on a terminal with a QR code of its address. An error is only a
    // message: the run continues without a page.
    std::string open_web() {
        if (!options_.web) return "";
        auto web = RunWeb::open(
            *loop_, *console_, *options_.web,
            {.look = [this] { return rtm_ ? rtm_->look() : std::future<std::string>(); }, .ask = peer_asker()},
            journal_.conditions());
        if (!web) return visible("no page for browsers: " + web.error().message);
        web_ = std::move(*web);
        loop_->add(*web_);
        return (isatty(STDERR_FILENO) != 0 ? web_->picture() : "") + visible(web_->where());
    }

    PeerAsker peer_asker() {
        return [this](const PeerRequest& request) { return rtm_ ? rtm_->ask(request) : refused_peers(); };
    }

    // A replay uses no RTCs: their acts are in the journal.
    Expected<void> open_rtm() {
        if (openrtm::RtmWord::find(live_->spec()) == nullptr || !options_.replay.empty()) return {};
        auto rtm = RunRtm::open(*loop_, live_->options().build.log);
        if (!rtm) return Unexpected(rtm.error());
        rtm_ = std::move(*rtm);
        loop_->add(*rtm_);
        return {};
    }

    // Ends the files of a run that failed. The recording keeps its complete rows, followed by the reason.
    Expected<int> give_up(const Error& error) {
        std::string why = visible(describe(error));
        std::replace(why.begin(), why.end(), '\n', ' ');
        Error told = error;
        journal_.give_up(describe(error));
        told.message += results_.discard(why);
        return Unexpected(std::move(told));
    }

    // Reports a command of --batch that was cut off by a signal or by --duration. Returns true if there is one, or if a
    // signal ended the run.
    bool tell_cut_off() {
        if (!options_.batch || !(loop_->interrupted() || loop_->came_to_end())) return false;
        const int line = console_->unfinished_line();
        const std::string why = loop_->interrupted()
                                    ? "a signal ended the run"
                                    : fmt::format("--duration ended the run at {:g} s", options_.duration);
        if (line > 0) screen_.say(fmt::format("line {}: not run to its end: {}", line, why));
        return line > 0 || loop_->interrupted();
    }

    // True if the outputs of the run are slower than the run.
    bool is_behind() const {
        return screen_.is_behind() || journal_.is_behind() || results_.is_behind() ||
               (options_.batch && console_ && console_->is_behind());
    }

    // After a signal, the next three functions are called on other threads.

    void give_up_files() {
        results_.give_up();
        journal_.give_up_file();
        if (devices_) devices_->give_up();
    }

    void end_at_once() {
        hw::Guard::brake_all();
        results_.end_at_once();
        if (prompt_) tcsetattr(STDIN_FILENO, TCSANOW, &terminal_before_);
    }

    StopSignals::Held held() const {
        return {.by = doing_.load(), .status = results_are_written_ ? exit_failed : exit_could_not_run};
    }

    Expected<int> finish(const std::string& how) {
        // The output of --batch must be the same each time, and the duration is not.
        if (!options_.batch) screen_.say(how);
        if (!costs_.empty()) screen_.say(costs_);
        int status = (!console_ || console_->all_well()) && !tell_cut_off() ? exit_done : exit_failed;
        if (devices_ && !devices_->finish()) status = exit_failed;
        for (const auto& component : live_->system().components()) {
            if (component->state() != LifeState::error) continue;
            screen_.say(fmt::format("nezumi: {} ended in ERROR: {}", component->name(),
                                    visible_message(describe(component->last_error()))));
            status = exit_failed;
        }
        screen_.flush(usual_flush);
        doing_ = "standard output";
        if (options_.trace_hash) put_text(stdout, fmt::format("trace hash: {:016x}\n", results_.hash()));
        if (const std::string lost = lost_output(); !lost.empty()) return failure(lost);
        return status;
    }

    RunOptions options_;
    bool prompt_;
    termios terminal_before_{};
    std::atomic<const char*> doing_ = "a tick";  // what the run is waiting for if it does not end
    std::atomic<bool> results_are_written_ = false;
    RunResults results_;
    std::optional<RunProfile> profile_;
    std::string costs_;  // the table of costs
    std::optional<RunDevices> devices_;
    RunJournal journal_;                  // its files must outlive the system
    std::optional<StopSignals> signals_;  // its thread uses all members above
    Screen screen_;                       // must outlive everything that prints through it
    Problems problems_;
    dds::Domains domains_;
    std::unique_ptr<RunningSystem> live_;
    std::optional<RunLoop> loop_;
    std::optional<RunConsole> console_;
    std::unique_ptr<RunWeb> web_;  // destroyed before the console that it uses
    std::unique_ptr<RunRtm> rtm_;
    std::optional<RealTime> real_time_;
};

}  // namespace

int run_system(RunOptions options) { return Run(std::move(options))(); }

}  // namespace nezumi::cli
