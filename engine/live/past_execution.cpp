// A second system repeats the run up to the execution, performs its tick, and is not needed afterwards.
#include "engine/live/past_execution.hpp"

#include <fmt/format.h>

#include <cmath>

namespace nezumi {
namespace {

Unexpected failed_outside(std::string_view component) {
    return failure(fmt::format("{} failed outside an execution: errors() shows where", component));
}

}  // namespace

Expected<std::unique_ptr<PastExecution>> PastExecution::begin(RunningSystem& live, std::string_view component) {
    const System& system = std::as_const(live).system();
    const Component* const its = system.find(component);
    if (its == nullptr) return failure(fmt::format("{} is gone", component));
    if (its->script_file() == nullptr) return failure(fmt::format("{} is not a behaviour: it has no lines", component));
    const double seconds = its->executed_at();
    const bool failed = its->state() == LifeState::error;
    if (failed && its->failed_at() != seconds) return failed_outside(component);
    if (seconds < 0) return failure(fmt::format("{} has not been executed yet", component));
    auto run = live.begin_seek({.tick = std::llround(seconds * system.settings().rate), .start = live.starts()});
    if (!run) return Unexpected(run.error());
    return std::unique_ptr<PastExecution>(new PastExecution(std::string(component), seconds, std::move(*run)));
}

Expected<Explanation> PastExecution::explain() {
    RunningSystem& then = run_->system();
    then.repeat_known();  // the execution may depend on acts before the tick
    const auto trace = then.explain_next(component_);
    if (!trace) return failed_outside(component_);
    then.tick();
    const auto seen = then.explanation(component_, *trace);
    if (!seen) return Unexpected(seen.error());
    if (!*seen) return failed_outside(component_);
    return **seen;
}

}  // namespace nezumi
