// Reads the files of the start from memory, so that files that were saved later do not change the past.
#include "engine/live/past_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace nezumi {

Expected<std::unique_ptr<PastRun>> PastRun::begin(RunningSystem& live, std::size_t branch, const Seek& where,
                                                  const ActTime& to) {
    std::unique_ptr<PastRun> past(new PastRun(live, branch, where, to));
    past->files_.update(live.history().files());
    LiveOptions options = live.options();
    options.files = &past->files_;
    options.build.log = {};
    options.build.out_of_time_is_fatal = false;
    options.print = {};
    options.watch = false;
    options.is_replay = true;
    options.network = options.network_of_past ? options.network_of_past : options.network;
    auto system = RunningSystem::load(live.file(), std::move(options));
    if (!system) return failure("the past can't be computed again: " + describe(system.error()));
    past->system_ = std::move(*system);
    past->system_->repeat(live.history().course(branch));
    past->system_->activate();
    return past;
}

Expected<bool> PastRun::go_on(Clock::time_point until) {
    for (;;) {
        // At the end of a branch, the acts that came then are included.
        system_->repeat_known(!is_there() || where_.tick < 0);
        if (const auto& differs = system_->differs()) {
            return failure(
                fmt::format("the past can't be computed again: at tick {} of start {} the computed run differs from "
                            "the original run",
                            differs->tick, differs->start));
        }
        remember_when_near();
        if (is_there()) return true;
        if (Clock::now() >= until) return false;
        system_->tick();
        ++ticks_;
    }
}

Expected<bool> PastRun::go_on_beside(Clock::time_point until) {
    constexpr std::chrono::milliseconds longest_wait{100}, least_work{1};
    constexpr std::chrono::microseconds more{1};
    const auto now = Clock::now();
    until -= 2 * tick_time_;
    if (until <= now) {
        if (now - worked_ < longest_wait) return false;
        until = now + least_work;
    }
    const std::int64_t before = ticks_;
    auto there = go_on(until);
    worked_ = Clock::now();
    if (ticks_ == before) return there;
    // Other programs also use time of a slice, so the measured time may be too long: the estimate grows slowly.
    const auto took = (worked_ - now) / (ticks_ - before);
    tick_time_ = before == 0 ? took : std::min<Clock::duration>(took, tick_time_ + tick_time_ / 8 + more);
    return there;
}

void PastRun::remember(Trace::Memory memory, std::int64_t from) {
    memory_ = std::move(memory);
    memory_from_ = from;
}

// Remembers values only near the moment, because earlier ones would be dropped before it is reached. Channels that an
// act adds are remembered from then on.
void PastRun::remember_when_near() {
    const ActTime now = system_->when();
    if (now.start != to_.start || now.tick < memory_from_) return;
    const std::uint64_t layout = std::as_const(*system_).system().layout();
    if (memory_layout_ == layout) return;
    memory_layout_ = layout;
    system_->trace().remember(memory_);
}

double PastRun::progress() const {
    // Counts only the last start, because the lengths of earlier starts are only known at their ends.
    const ActTime now = system_->when();
    if (now.start != to_.start) return 0;
    return to_.tick == 0 ? 1 : static_cast<double>(now.tick) / static_cast<double>(to_.tick);
}

}  // namespace nezumi
