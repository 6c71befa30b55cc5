// Takes inputs one after the other through Lua, and tells what came of them.
#include "bindings/console/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bindings/console/input_text.hpp"
#include "bindings/console/session_parts.hpp"
#include "bindings/console/words.hpp"
#include "bindings/lua/live/inspect.hpp"
#include "bindings/lua/live/live_text.hpp"
#include "bindings/lua/sandbox/stdlib.hpp"

namespace nezumi {
namespace {

constexpr Budget input_budget{5.0};
constexpr std::size_t watch_width = 100;        // [characters]
constexpr double highest_watched_speed = 1000;  // "max" has no number

// One line of an input needs no place; of several, the line says more than the input's name.
std::string error_text(const Error& error, std::string_view input) {
    if (error.place.file != input_name || error.place.line <= 0) return describe(error);
    if (input.find('\n') == std::string_view::npos) return error.message;
    return fmt::format("line {}: {}", error.place.line, error.message);
}

void show_results(const Session::Parts& parts, lua_State* L) {
    const int count = lua_gettop(L);
    if (count == 0) return;
    std::vector<std::string> texts;
    bool several_lines = false;
    InspectWork work;
    for (int i = 1; i <= count; ++i) {
        const Word* word = word_at(L, i);
        texts.push_back(word != nullptr ? fmt::format("{}: {}", word->usage, word->help)
                                        : inspect(L, i, {.work = &work}));
        several_lines = several_lines || texts.back().find('\n') != std::string::npos;
    }
    parts.show(fmt::format("{}", fmt::join(texts, several_lines ? "\n" : "\t")));
}

// Whoever types the bare word that leaves wants to leave, not to read what it does.
bool is_goodbye(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(" \t\n");
    if (begin == std::string_view::npos) return false;
    text = text.substr(begin, text.find_last_not_of(" \t\n") + 1 - begin);
    return text == "quit" || text == "exit";
}

// Shows what is new on a watched port. Returns false when the port is gone.
bool look(const Session::Parts& parts, Watch& watch) {
    const System& system = parts.live.system();
    const auto port = system.port(watch.path);
    if (!port) return false;
    if ((*port)->count() == 0) return true;
    const double now = (*port)->tm();
    // A batch leaves nothing out.
    const double speed = std::clamp(parts.clock.speed(), 1.0, highest_watched_speed);
    const double period = parts.options.batch ? 0 : parts.options.watch_period * speed;
    if (watch.shown_at >= 0 && now >= watch.shown_at && now < watch.shown_at + period) return true;
    std::string text = payload_text((*port)->value(), watch_width);
    if (watch.shown_at >= 0 && text == watch.shown) return true;
    parts.show(fmt::format("[{:.3f}] {} = {}", now, watch.path, text));
    watch.shown = std::move(text);
    watch.shown_at = now;
    return true;
}

}  // namespace

Session::Parts::Parts(LiveSystem& system, ClockControl& control, SessionOptions settings)
    : live(system), clock(control), options(std::move(settings)) {}

Expected<void> Session::Parts::open() {
    call.reset();
    auto fresh = create_sandbox({.print = [this](std::string_view line) { show(line); }});
    if (!fresh) return Unexpected(fresh.error());
    auto opened = Objects::open(
        **fresh, [this]() -> LiveSystem& { return live; }, options.who);
    if (!opened) return Unexpected(opened.error());
    state = std::move(*fresh);
    objects = std::move(*opened);
    objects->set_hardware(clock.is_hardware());
    return open_scope(*this);
}

Expected<std::unique_ptr<Session>> Session::create(LiveSystem& live, ClockControl& clock, SessionOptions options) {
    auto parts = std::make_unique<Parts>(live, clock, std::move(options));
    if (auto ok = parts->open(); !ok) return Unexpected(ok.error());
    return std::unique_ptr<Session>(new Session(std::move(parts)));
}

Session::Session(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

Session::~Session() {
    if (parts_->drive.is_on()) parts_->drive.end(parts_->live);
    static_cast<void>(parts_->drive.after_tick(parts_->live));  // lets the port go
}

bool Session::is_complete(std::string_view text) { return is_complete_input(text); }

void Session::submit(std::string text) {
    if (is_goodbye(text)) text = "quit()";
    parts_->inputs.push_back(std::move(text));
}

bool Session::is_busy() const { return parts_->call != nullptr || !parts_->inputs.empty(); }

bool Session::is_waiting() const { return parts_->call != nullptr && parts_->waiting && parts_->clock.is_advancing(); }

void Session::finish(bool well) {
    parts_->call.reset();
    parts_->waiting = false;
    if (parts_->state->is_lost()) {
        parts_->show_error("what was defined here is lost with it");
        if (auto ok = parts_->open(); !ok) parts_->show_error(describe(ok.error()));
    }
    if (parts_->options.output.done) parts_->options.output.done(well);
}

// Begins the next input. Returns whether one runs now.
bool Session::begin_next() {
    Parts& parts = *parts_;
    while (parts.call == nullptr && !parts.inputs.empty()) {
        parts.input = std::move(parts.inputs.front());
        parts.inputs.pop_front();
        const auto refuse = [&](const Error& error) {
            parts.show_error(error_text(error, parts.input));
            finish(false);
        };
        const auto chunk = compile_input(parts.input);
        if (!chunk) {
            refuse(chunk.error());
            continue;
        }
        if (auto loaded = load_chunk(parts.state->lua(), *chunk); !loaded) {
            refuse(loaded.error());
            continue;
        }
        auto call = SlicedCall::start(*parts.state, 0, input_budget);
        if (!call) {
            refuse(call.error());
            continue;
        }
        parts.call = std::move(*call);
    }
    return parts.call != nullptr;
}

bool Session::advance(std::chrono::microseconds slice) {
    Parts& parts = *parts_;
    const auto end = std::chrono::steady_clock::now() + slice;
    for (;;) {
        if (is_waiting() || !begin_next()) return false;
        parts.waiting = false;
        const auto left = std::chrono::duration_cast<std::chrono::microseconds>(end - std::chrono::steady_clock::now());
        if (left.count() <= 0) return true;
        switch (parts.call->advance(left)) {
            case SlicedCall::Progress::running: break;
            case SlicedCall::Progress::finished:
                show_results(parts, parts.call->results());
                finish(true);
                break;
            case SlicedCall::Progress::failed:
                parts.show_error(error_text(parts.call->error(), parts.input));
                finish(false);
                break;
        }
    }
}

void Session::after_tick() {
    Parts& parts = *parts_;
    std::erase_if(parts.watches, [&parts](Watch& watch) {
        if (look(parts, watch)) return false;
        parts.show(fmt::format("{} is gone: no longer watched", watch.path));
        return true;
    });
    if (auto driving = parts.drive.after_tick(parts.live); !driving) {
        parts.show(driving.error().message);
        if (parts.options.output.take_keys) parts.options.output.take_keys(false);
    }
}

void Session::interrupt() {
    Parts& parts = *parts_;
    if (parts.drive.is_on()) key(Key::escape);
    parts.watches.clear();
    const std::size_t dropped = parts.inputs.size();
    parts.inputs.clear();
    if (parts.call != nullptr) {
        if (is_waiting()) parts.clock.pause();
        parts.show_error("interrupted");
        finish(false);
    }
    for (std::size_t i = 0; i < dropped; ++i) {
        if (parts.options.output.done) parts.options.output.done(false);
    }
}

void Session::key(Key key) {
    Parts& parts = *parts_;
    const bool was_on = parts.drive.is_on();
    parts.drive.key(key, parts.live);
    if (was_on && !parts.drive.is_on() && parts.options.output.take_keys) parts.options.output.take_keys(false);
}

}  // namespace nezumi
