// Remembers only the requested channels, and all their values as far as the memory of a trace allows.
#include "engine/live/past_values.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/list.hpp"

namespace nezumi {
namespace {

// The computation starts before the first requested tick, because messages at an in-port are kept only from the tick
// after it is followed.
constexpr std::int64_t ticks_before = 2;

std::int64_t tick_at(const RunningSystem& live, double seconds) {
    return std::llround(seconds * live.system().settings().rate);
}

}  // namespace

Expected<std::unique_ptr<PastValues>> PastValues::begin(RunningSystem& live, std::vector<std::string> names,
                                                        double from, double to) {
    const std::int64_t tick = tick_at(live, to);
    // If the end is the present, the acts after the last tick are included: they may have added a requested channel.
    const bool is_present = tick >= live.when().tick && !live.is_past();
    auto run = live.begin_seek({.tick = is_present ? -1 : std::min(tick, live.when().tick), .start = live.starts()});
    if (!run) return Unexpected(run.error());
    Trace::Memory memory{
        .names = names, .most_samples = std::numeric_limits<std::size_t>::max(), .most_bytes = Trace::most_bytes};
    (*run)->remember(std::move(memory), tick_at(live, from) - ticks_before);
    return std::unique_ptr<PastValues>(
        new PastValues(std::move(names), from, live.system().now().seconds, std::move(*run)));
}

bool PastValues::extend(const RunningSystem& live, const std::vector<std::string>& names, double from, double to) {
    if (run_->generation() != live.generation() || from < from_ || to > known_) return false;
    const auto has = [&](const std::string& name) { return contains(names_, name); };
    if (!std::all_of(names.begin(), names.end(), has)) return false;
    run_->extend(std::max(run_->system().when().tick, tick_at(live, to)));
    return true;
}

}  // namespace nezumi
