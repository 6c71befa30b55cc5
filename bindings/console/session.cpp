// Runs inputs one after the other in Lua, and reports the results.
#include "bindings/console/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "bindings/console/input_text.hpp"
#include "bindings/console/session_parts.hpp"
#include "bindings/lua/sandbox/stdlib.hpp"
#include "engine/base/trimmed.hpp"

namespace nezumi {
namespace {

// The longest time that a session waits for an interrupted input to end. Lua code ends within a second; a function in
// C++ may take longer.
constexpr std::chrono::seconds stuck_after{2};
constexpr std::chrono::seconds session_farewell{1};

// A person who types only `quit` or `exit` wants to leave, not to read what the command does.
bool is_goodbye(std::string_view text) {
    text = trimmed(text);
    return text == "quit" || text == "exit";
}

// Ends a job that is not run: answers with nothing, or reports that the input failed.
void drop(const Session::Parts& parts, const Job& job) {
    if (job.answer) return job.answer({});
    if (parts.options.output.done) parts.options.output.done(false);
}

Expected<std::unique_ptr<Session::Parts>> make_parts(RunningSystem& live, ClockControl& clock, SessionOptions options) {
    try {
        return std::make_unique<Session::Parts>(live, clock, std::move(options));
    } catch (const std::system_error& error) {
        return failure(fmt::format("no thread is left for another console: {}", error.code().message()));
    }
}

}  // namespace

Session::Parts::Parts(RunningSystem& system, ClockControl& control, SessionOptions settings)
    : live(system), clock(control), options(std::move(settings)), is_hardware(control.is_hardware()), worker(bell()) {}

void Session::Parts::tell(const std::function<void(std::string_view)>& output, std::string_view text) {
    if (!output) return;
    if (!worker.is_here()) return output(text);
    worker.post(text.size(), [&output, text = std::string(text)] { output(text); });
}

Expected<ActResult> Session::Parts::act_beside(const Act& act, const FilesSeen& found,
                                               const std::function<Expected<void>(const PreparedAct&)>& check) {
    for (;;) {
        const auto prepare = at_system([&] { return live.prepare(act, found); });
        if (!prepare) return failure("interrupted");
        PreparedAct prepared = prepare();
        if (const auto ok = check ? check(prepared) : Expected<void>(); !ok) return Unexpected(ok.error());
        bool fits = false;
        const auto done = at_system([&] {
            fits = live.fits(prepared);
            return std::make_optional(fits ? live.commit(std::move(prepared), options.who) : Expected<ActResult>());
        });
        if (!done) return failure("interrupted");
        if (fits) return *done;
    }
}

Expected<void> Session::Parts::open() {
    auto fresh = create_sandbox({.print = [this](std::string_view line) { show(line); }});
    if (!fresh) return Unexpected(fresh.error());
    auto opened = Objects::open(
        **fresh, [this]() -> RunningSystem& { return live; }, options.who);
    if (!opened) return Unexpected(opened.error());
    state = std::move(*fresh);
    objects = std::move(*opened);
    objects->set_hardware(is_hardware);
    objects->set_visit([this](const Worker::Work& look) { return worker.perform(look); });
    return open_scope(*this);
}

void Session::Parts::open_if_lost() {
    if (!state->is_lost()) return;
    show_error("definitions made in this console are lost");
    if (auto ok = open(); !ok) show_error(describe(ok.error()));
}

Expected<std::unique_ptr<Session>> Session::create(RunningSystem& live, ClockControl& clock, SessionOptions options) {
    auto parts = make_parts(live, clock, std::move(options));
    if (!parts) return Unexpected(parts.error());
    std::unique_ptr<Session> session(new Session(std::move(*parts)));
    if (auto ok = session->parts_->open(); !ok) return Unexpected(ok.error());
    return session;
}

Session::Session(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

Session::~Session() {
    close();
    // A thread that does not end keeps the objects that it uses.
    if (!parts_->worker.join(*closed_ + session_farewell)) static_cast<void>(parts_.release());
}

void Session::close() {
    if (closed_) return;
    Parts& parts = *parts_;
    if (parts.drive.is_on()) parts.drive.end(parts.live);
    static_cast<void>(parts.drive.after_tick(parts.live));  // releases the port
    const bool looks = !parts.breaks.empty() || parts.profile != nullptr;
    parts.breaks.clear();
    parts.profile.reset();
    if (looks) watch_lines(parts);
    if (parts.quits) parts.clock.quit();
    parts.worker.close([&parts] {
        parts.state.reset();
        parts.objects.reset();
    });
    closed_ = Worker::Clock::now();
}

bool Session::has_ended() const { return parts_->worker.has_ended(); }

bool Session::is_complete(std::string_view text) { return is_complete_input(text); }

void Session::submit(std::string text) {
    if (is_goodbye(text)) text = "quit()";
    // A person who types `stop` in a hurry means the command, not its help.
    if (trimmed(text) == "stop") text = "stop()";
    parts_->jobs.push_back({.text = std::move(text)});
}

void Session::complete(std::string text, std::size_t cursor, std::function<void(Completion)> answer) {
    parts_->jobs.push_back({std::move(text), cursor, std::move(answer)});
}

bool Session::is_busy() const { return parts_->job || !parts_->jobs.empty(); }

bool Session::is_waiting() const {
    const auto& takes_more = parts_->options.output.takes_more;
    return parts_->job && (parts_->awaits_explanation || (parts_->waiting && parts_->clock.is_advancing()) ||
                           (takes_more && !takes_more()));
}

// Whether an explained behaviour executes soon. The input then waits for the explanation, because `--eval` ends at the
// answer.
bool Session::explains_soon() const {
    return !parts_->options.batch && !parts_->clock.is_paused() &&
           std::any_of(parts_->explained.begin(), parts_->explained.end(), [&](const Explained& each) {
               const Component* component = parts_->live.system().find(each.component);
               return component != nullptr && component->state() == LifeState::active;
           });
}

void Session::finish(bool well) {
    parts_->awaits_explanation = well && explains_soon();
    if (parts_->awaits_explanation) return;
    parts_->job.reset();
    if (parts_->options.output.done) parts_->options.output.done(well);
}

void Session::begin_next() {
    if (parts_->job || parts_->jobs.empty()) return;
    if (!parts_->worker.is_idle()) {
        const bool stuck = parts_->revoked && Worker::Clock::now() - *parts_->revoked > stuck_after;
        if (!stuck) return;
        replace_stuck();
        if (!parts_->worker.is_idle()) return;
    }
    Parts& parts = *parts_;
    parts.job = std::move(parts.jobs.front());
    parts.jobs.pop_front();
    parts.waiting = false;
    parts.revoked.reset();
    parts.worker.start([this, &parts, job = *parts.job] {
        parts.open_if_lost();
        if (job.answer) {
            parts.worker.post(0, [this, answer = job.answer, found = nezumi::complete(parts, job.text, job.cursor)] {
                parts_->job.reset();
                answer(found);
            });
            return;
        }
        parts.run(job.text, [this, &parts](bool well) {
            parts.open_if_lost();
            parts.worker.post(0, [this, well] { finish(well); });
        });
    });
}

// Replaces the thread and the Lua state if the interrupted job does not end: it waits for a file, or runs code that
// can't be stopped.
void Session::replace_stuck() {
    auto fresh = make_parts(parts_->live, parts_->clock, parts_->options);
    if (fresh) {
        if (auto ok = (*fresh)->open(); !ok) fresh = Unexpected(ok.error());
    }
    parts_->show_error("the interrupted command did not end: definitions made in this console are lost");
    if (!fresh) {
        parts_->revoked = Worker::Clock::now();  // starts the time again, to try again later
        return parts_->show_error(describe(fresh.error()));
    }
    (*fresh)->jobs = std::move(parts_->jobs);
    (*fresh)->watches = std::move(parts_->watches);
    (*fresh)->plots = std::move(parts_->plots);
    (*fresh)->drive = std::move(parts_->drive);
    parts_->worker.close({});
    const bool ended = parts_->worker.join(Worker::Clock::now());
    if (!ended) static_cast<void>(parts_.release());
    parts_ = std::move(*fresh);
}

void Session::serve(Worker::Clock::time_point until) {
    const bool looks = !parts_->breaks.empty() || parts_->profile != nullptr;
    if (looks && parts_->breaks_of != parts_->live.generation()) watch_lines(*parts_);
    begin_next();
    parts_->worker.serve(until, parts_->options.output.takes_more);
    quit_if_asked();
}

// Ends the run after `quit()`. First lets the input finish, so that its answer is sent, but for at most `patience`.
void Session::quit_if_asked() {
    constexpr std::chrono::milliseconds patience{200};
    if (parts_->quits && (!parts_->job || Worker::Clock::now() - *parts_->quits > patience)) parts_->clock.quit();
}

bool Session::advance(std::chrono::microseconds slice) {
    const auto end = Worker::Clock::now() + slice;
    for (;;) {
        const Bell& bell = parts_->bell();
        bell.clear();
        serve(end);
        if (!is_busy() || is_waiting()) return false;
        if (!bell.wait(end) || Worker::Clock::now() >= end) return true;
    }
}

void Session::after_tick() {
    Parts& parts = *parts_;
    std::erase_if(parts.watches, [&parts](PortWatch& watch) {
        if (show_news(parts, watch)) return false;
        parts.show(fmt::format("{} is gone: no longer watched", watch.path));
        return true;
    });
    std::erase_if(parts.explained, [&parts](const Explained& each) {
        const bool is_same = each.start == parts.live.generation();
        const auto seen = is_same ? parts.live.explanation(each.component, each.trace)
                                  : Expected<std::optional<Explanation>>(
                                        failure(each.component + " was replaced by a restart or a seek"));
        if (seen && !*seen) return false;
        if (seen) {
            parts.show(to_text(**seen));
        } else {
            parts.show(seen.error().message + ": not explained");
        }
        return true;
    });
    if (parts.awaits_explanation && !explains_soon()) finish(true);
    std::erase_if(parts.changes, [&parts](ChangeWatch& watch) {
        if (show_change(parts, watch)) return false;
        parts.show(fmt::format("{} is gone: no longer watched", watch.name));
        return true;
    });
    stop_at_breaks(parts);
    show_profile(parts);
    std::erase_if(parts.plots, [&parts](PlotRequest& plot) { return !draw_again(parts, plot); });
    if (auto driving = parts.drive.after_tick(parts.live); !driving) {
        parts.show(driving.error().message);
        if (parts.options.output.take_keys) parts.options.output.take_keys(TakenKeys::none);
    }
}

void Session::interrupt() {
    Parts& parts = *parts_;
    if (parts.drive.is_on()) key(Key::escape);
    give_keys(parts, false);
    parts.watches.clear();
    parts.changes.clear();
    if (std::exchange(parts.profile, nullptr) != nullptr) watch_lines(parts);
    parts.explained.clear();
    parts.awaits_explanation = false;
    parts.plots.clear();
    parts.worker.serve_posts();
    auto jobs = std::exchange(parts.jobs, {});
    if (parts.job) {
        if (parts.waiting && parts.clock.is_advancing() && parts.clock.moves() == parts.moves) parts.clock.pause();
        parts.worker.revoke();
        parts.revoked = Worker::Clock::now();
        if (!parts.job->answer) parts.show_error("interrupted");
        jobs.push_front(std::move(*parts.job));
        parts.job.reset();
    }
    for (const Job& job : jobs) drop(parts, job);
    quit_if_asked();
}

void Session::key(Key key) {
    Parts& parts = *parts_;
    if (parts.seek_has_keys && key == Key::escape) return interrupt();
    const bool was_on = parts.drive.is_on();
    parts.drive.key(key, parts.live);
    if (parts.drive.is_on() && (key == Key::faster || key == Key::slower))
        parts.show("at full deflection: " + parts.drive.full_speed());
    if (was_on && !parts.drive.is_on() && parts.options.output.take_keys)
        parts.options.output.take_keys(TakenKeys::none);
}

}  // namespace nezumi
