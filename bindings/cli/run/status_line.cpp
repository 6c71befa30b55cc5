// Built from parts with one colour each, so that it is shortened by its visible length.
#include "bindings/cli/run/status_line.hpp"

#include <fmt/format.h>

#include <chrono>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

namespace nezumi::cli {
namespace {

constexpr std::chrono::milliseconds period{100};
constexpr std::size_t most_samples = 11;  // per second
constexpr std::size_t most_names = 6;     // with more components, they are counted instead of named

struct Piece {
    std::string text;
    std::string_view colour;
};

std::string_view colour_of_state(LifeState state) {
    switch (state) {
        case LifeState::active: return "\x1b[32m";
        case LifeState::inactive: return "\x1b[2m";
        case LifeState::error: return "\x1b[31m";
    }
    return "";
}

void add_states(const System& system, std::vector<Piece>& pieces) {
    const bool named = system.components().size() <= most_names;
    std::map<LifeState, std::size_t> counts;
    for (const auto& component : system.components()) {
        const LifeState state = component->state();
        ++counts[state];
        if (named || state == LifeState::error)
            pieces.push_back({fmt::format("  {} {}", component->name(), to_text(state)), colour_of_state(state)});
    }
    if (named) return;
    for (const LifeState state : {LifeState::active, LifeState::inactive}) {
        if (counts[state] > 0)
            pieces.push_back({fmt::format("  {} {}", counts[state], to_text(state)), colour_of_state(state)});
    }
}

}  // namespace

bool StatusLine::serve(Pacer::Clock::time_point /*until*/) {
    const auto now = Pacer::Clock::now();
    if (!samples_.empty() && now - samples_.back().wall < period) return false;
    samples_.push_back({now, loop_.advanced()});
    if (samples_.size() > most_samples) samples_.pop_front();
    show(static_cast<std::size_t>(Screen::width() - 1));
    return false;
}

double StatusLine::reached_speed() const {
    if (samples_.size() < 2) return 0;
    const std::chrono::duration<double> wall = samples_.back().wall - samples_.front().wall;
    return (samples_.back().simulated - samples_.front().simulated) / wall.count();
}

void StatusLine::show(std::size_t columns) {
    const System& system = loop_.live().system();
    std::vector<Piece> pieces{{fmt::format("{:10.2f} s", system.now().seconds), "\x1b[1m"}};
    if (loop_.is_paused()) {
        pieces.push_back({"  paused", "\x1b[33m"});
    } else {
        const double speed = reached_speed();
        pieces.push_back({fmt::format("  {:.{}f}x", speed, speed < 100 ? 2 : 0), ""});
    }
    add_states(system, pieces);
    const Lateness lateness = loop_.lateness();
    if (lateness.ticks() > 0) {
        pieces.push_back({"  late by " + to_text(lateness), ""});
        if (lateness.skipped() > 0)
            pieces.push_back({fmt::format(", {} ticks skipped", lateness.skipped()), "\x1b[33m"});
    }

    std::string line;
    std::size_t room = columns;
    for (const Piece& piece : pieces) {
        const std::string_view seen = std::string_view(piece.text).substr(0, room);
        room -= seen.size();
        line += piece.colour;
        line += seen;
        if (!piece.colour.empty()) line += "\x1b[0m";
    }
    screen_.show_status(std::move(line), static_cast<int>(columns - room));
}

}  // namespace nezumi::cli
