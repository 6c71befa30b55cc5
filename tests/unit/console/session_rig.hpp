// A session on a live system, a clock that a test turns by hand, and all that the session said.
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings/console/session.hpp"
#include "bindings/console/worker.hpp"
#include "engine/live/problems.hpp"
#include "tests/unit/live_rig.hpp"

namespace nezumi {

struct SessionRig : LiveRig, ClockControl {
    explicit SessionRig(const std::string& system = counter_system,
                        const std::map<std::string, std::string>& behaviors = {{"counter", counter_behavior}},
                        SessionOptions options = {}, const ProjectFiles& files = disk(), bool is_real = false)
        : LiveRig(system, behaviors, files), hardware(is_real) {
        options.output.show = [this](std::string_view text) { add(text); };
        // As in a terminal: what is directly above and in place goes.
        options.output.show_in_place = [this](std::string_view text) {
            if (shown.ends_with(in_place)) shown.resize(shown.size() - in_place.size());
            const std::size_t before = shown.size();
            add(text);
            in_place = shown.substr(before);
        };
        options.output.show_error = [this](std::string_view text) { add("! " + std::string(text)); };
        options.output.done = [this](bool well) { all_well = all_well && well, ++finished; };
        options.output.take_keys = [this](TakenKeys taken) { keys = taken != TakenKeys::none; };
        options.bell = &bell;
        session = std::move(Session::create(*live, *this, std::move(options)).value());
    }

    /// What an input shows, its lines joined.
    std::string type(std::string text) {
        shown.clear();
        in_place.clear();
        all_well = true;
        session->submit(std::move(text));
        for (int rounds = 0; session->is_busy(); ++rounds) {
            if (rounds > 100'000) return "it never ends";
            session->advance();
            if (is_advancing()) turn();
        }
        return shown;
    }

    /// What could stand behind a text.
    Completion complete(std::string text) {
        std::optional<Completion> found;
        const std::size_t cursor = text.size();
        session->complete(std::move(text), cursor, [&](Completion completion) { found = std::move(completion); });
        for (int rounds = 0; !found && rounds < 100'000; ++rounds) session->advance();
        return found.value_or(Completion{0, {"no answer"}});
    }

    /// Ticks, as the loop does them.
    void turn(int ticks = 1) {
        for (; ticks > 0; --ticks) {
            live->tick();
            if (left > 0 && --left == 0) paused = true;
            session->after_tick();
        }
    }

    void add(std::string_view text) { shown += (shown.empty() ? "" : "\n") + std::string(text); }

    bool is_hardware() const override { return hardware; }
    void pause() override { ++moved, paused = true, left = 0; }
    void resume() override { ++moved, paused = false, left = 0; }
    bool is_paused() const override { return paused; }
    void advance(std::int64_t ticks) override { ++moved, paused = false, left = ticks; }
    std::uint64_t moves() const override { return moved; }
    bool is_advancing() const override { return left > 0; }
    void set_speed(double factor) override { factor_ = factor; }
    double speed() const override { return factor_; }
    void quit() override {
        if (!quitting) finished_at_quit = finished;
        quitting = true;
    }
    std::vector<LogLine> problems() const override {
        Problems problems;
        for (const LogLine& line : log) problems.take(line);
        return problems.lines();
    }

    bool hardware = false;
    bool paused = true;
    bool quitting = false;
    bool keys = false;
    std::int64_t left = 0;
    std::uint64_t moved = 0;
    double factor_ = 1;
    int finished = 0;
    int finished_at_quit = 0;
    bool all_well = true;
    std::string shown;
    std::string in_place;  // its latest part that may be replaced
    Bell bell;
    std::unique_ptr<Session> session;
};

}  // namespace nezumi
