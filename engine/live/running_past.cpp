// Going back in time: the present is replaced by a system that has computed the past.
#include <fmt/format.h>

#include <utility>

#include "engine/base/visible.hpp"
#include "engine/live/past_run.hpp"
#include "engine/live/running.hpp"
#include "engine/live/running_system.hpp"

namespace nezumi {

Expected<std::unique_ptr<PastRun>> RunningSystem::begin_seek(const Seek& where) {
    if (options_.build.real_time) return failure("real robots can't go back in time");
    if (!options_.is_replay && !spec().peers.empty())
        return failure("a system that is connected with other programs can't go back in time");
    if (file_.empty()) return failure("a system without a file can't go back in time");
    history_.reach(when(), system().now().seconds);
    const auto branch = where.branch.empty() ? std::optional(history_.current()) : history_.find(where.branch);
    if (!branch) return failure(fmt::format("there is no branch '{}': branches() lists them", shown(where.branch)));
    const ActTime& end = history_.branches()[*branch].end;
    ActTime to{where.start == 0 ? end.start : where.start, where.tick};
    if (where.tick < 0) to = end;
    if (is_earlier(end, to)) {
        return failure(
            fmt::format("{} ends at {:g} s", history_.branches()[*branch].name, history_.branches()[*branch].seconds));
    }
    return PastRun::begin(*this, *branch, where, to);
}

Expected<ActResult> RunningSystem::perform(const Seek& act, const Actor& /*who*/, PreparedAct* /*prepared*/) {
    auto past = begin_seek(act);
    if (!past) return Unexpected(past.error());
    if (auto there = (*past)->go_on(PastRun::Clock::time_point::max()); !there) return Unexpected(there.error());
    return take(**past);
}

Expected<ActResult> RunningSystem::take(PastRun& past) {
    if (past.generation() != generation_) return failure("the system has changed while the past was computed");
    history_.reach(when(), system().now().seconds);
    history_.go_to(past.branch(), past.system().history().position());
    RunningSystem& other = past.system();
    const FileWatcher::Files seen = running_->live_reload ? running_->live_reload->seen() : FileWatcher::Files();
    trace_.take_over(other.trace_);
    const std::unique_ptr<Running> before = replace(std::move(other.running_));
    running_->log = options_.build.log;
    starts_ = other.starts_;
    hash_before_ = other.hash_before_;
    foreseen_ = std::move(other.foreseen_);
    differs_.reset();
    if (options_.watch) running_->live_reload.emplace(*this, *running_->reloads, running_->spec.files, seen);
    return ActResult{};
}

const RunHistory& RunningSystem::history_until_now() {
    history_.reach(when(), system().now().seconds);
    return history_;
}

void RunningSystem::repeat(RunHistory past) {
    for (std::size_t index = 0; index < past.branches().front().size(); ++index) {
        const PastEvent& event = past.event(0, index);
        if (const auto* call = std::get_if<PastCall>(&event.what))
            foreseen_.push_back({event.when.start, event.when.tick, call->component, call->call});
    }
    history_ = std::move(past);
}

void RunningSystem::repeat_known(bool acts) {
    while (const PastEvent* event = history_.due(when())) {
        if (!acts && std::holds_alternative<std::shared_ptr<const PastAct>>(event->what)) return;
        history_.pass();
        bool same = true;
        if (const auto* hash = std::get_if<PastHash>(&event->what)) same = hash->hash == trace_hash();
        if (const auto* act_then = std::get_if<std::shared_ptr<const PastAct>>(&event->what)) {
            const PastAct& past = **act_then;
            repeats_ = true;
            const auto done =
                takes_files(past.act) ? commit(prepare(past.act, past.files)(), past.who) : act(past.act, past.who);
            repeats_ = false;
            same = done.has_value() != past.failed;
        }
        if (same || differs_) continue;
        differs_ = when();
        running_->system->log(LogLevel::error, "this run now differs from the original run");
    }
}

}  // namespace nezumi
