// Going back in time: the present is replaced by a system that has computed the past.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/list.hpp"
#include "engine/live/past_run.hpp"
#include "engine/live/running.hpp"
#include "engine/live/running_system.hpp"
#include "engine/ports/messages.hpp"
#include "engine/system/network.hpp"
#include "engine/system/peer_word.hpp"

namespace nezumi {

Expected<std::unique_ptr<PastRun>> RunningSystem::begin_seek(const Seek& where) {
    if (options_.build.real_time) return failure("real robots can't go back in time");
    if (has_peers()) {
        if (auto ok = check_peers(); !ok) return Unexpected(ok.error());
    }
    if (file_.empty()) return failure("a system without a file can't go back in time");
    if (history_.is_cut()) {
        return failure(fmt::format(
            "the past is not kept any more: the messages and acts of this run need more than {} MB; a journal "
            "(--journal) has them",
            RunHistory::most_bytes >> 20));
    }
    history_.reach(when(), system().now().seconds);
    const auto branch = where.branch.empty() ? std::optional(history_.current()) : history_.find(where.branch);
    if (!branch) {
        std::string hint = did_you_mean(where.branch, history_.branches(), &RunHistory::Branch::name);
        // The user may have left out the number of the branch.
        if (hint.empty()) hint = did_you_mean(where.branch + " 1", history_.branches(), &RunHistory::Branch::name);
        return failure(fmt::format("there is no branch '{}'{}: branches() lists them", shown(where.branch), hint));
    }
    const ActTime& end = history_.branches()[*branch].end;
    if (where.start < 0)
        return failure(fmt::format("expected a start from 1 on, or 0 for the last one, got {}", where.start));
    ActTime to{where.start == 0 ? end.start : where.start, where.tick};
    if (where.tick < 0) to = end;
    if (is_earlier(end, to)) {
        return failure(fmt::format("{} ends at {:g} s: no later time can be reached", history_.branches()[*branch].name,
                                   history_.branches()[*branch].seconds));
    }
    if (const auto its_end = history_.end_of_start(to.start, *branch); its_end && to.tick > *its_end) {
        return failure(fmt::format("the run after start {} in {} ends at {:g} s: no later time can be reached",
                                   to.start, history_.branches()[*branch].name,
                                   static_cast<double>(*its_end) / system().settings().rate));
    }
    return PastRun::begin(*this, *branch, where, to);
}

Expected<ActResult> RunningSystem::perform(const Seek& act, const Actor& /*who*/, PreparedAct* /*prepared*/) {
    if (is_back(act)) return come_back();
    auto past = begin_seek(act);
    if (!past) return Unexpected(past.error());
    if (auto there = (*past)->go_on(PastRun::Clock::time_point::max()); !there) return Unexpected(there.error());
    return take(**past);
}

Expected<ActResult> RunningSystem::take(PastRun& past) {
    if (past.generation() != generation_)
        return failure("the system has changed while the past was computed: try again");
    if (is_back(past.where())) return come_back();
    history_.reach(when(), system().now().seconds);
    if (has_peers()) {
        away_ = std::make_unique<Away>();
        away_->branch = history_.current();
        away_->when = when();
        away_->starts = starts_;
        away_->hash_before = hash_before_;
        away_->trace.take_over(trace_);
    }
    history_.go_to(past.branch(), past.system().history().position());
    RunningSystem& other = past.system();
    const FileWatcher::Files seen = running_->live_reload ? running_->live_reload->seen() : FileWatcher::Files();
    trace_.take_over(other.trace_);
    std::unique_ptr<Running> before = replace(std::move(other.running_));
    if (away_ && away_->running == nullptr) {
        before->live_reload.reset();
        away_->running = std::move(before);
    }
    running_->log = options_.build.log;
    starts_ = other.starts_;
    hash_before_ = other.hash_before_;
    foreseen_ = std::move(other.foreseen_);
    differs_.reset();
    if (options_.watch) running_->live_reload.emplace(*this, *running_->reloads, running_->spec.files, seen);
    return ActResult{};
}

Expected<void> RunningSystem::check_peers() const {
    for (const auto& [word, peer] : spec().peers) {
        if (!peer->word().needs_network() || !options_.network_of_past)
            return failure(
                fmt::format("a system that is connected with other programs by '{}' can't go back in time", word));
    }
    const Network* const network = system().network();
    if (network != nullptr && network->is_in_lockstep())
        return failure("hosts in lockstep share their time: none of them can go back alone");
    return {};
}

// Sends zero velocities to other hosts in one tick before the system leaves the present. The tick belongs to the run:
// messages that others have received are not taken back.
void RunningSystem::leave_peers(const Actor& who) {
    std::vector<std::string> held;
    for (const ConnectionSpec& each : system().connections()) {
        if (!is_remote(each.to) || contains(held, each.from)) continue;
        const auto port = running_->system->port(each.from);
        if (!port || (*port)->type() != message_of<Velocity2D>()) continue;
        if (act(Hold{each.from, Velocity2D{}, true}, who)) held.push_back(each.from);
    }
    if (held.empty()) return;
    tick();
    for (const std::string& path : held) static_cast<void>(act(Release{path}, who));
}

Seek RunningSystem::back() const { return {.branch = history_.branches()[away_ ? away_->branch : 0].name}; }

bool RunningSystem::is_back(const Seek& where) const {
    if (away_ == nullptr) return false;
    const auto branch = where.branch.empty() ? std::optional(history_.current()) : history_.find(where.branch);
    if (branch != away_->branch) return false;
    const ActTime& then = away_->when;
    return where.tick < 0 || (where.tick == then.tick && (where.start == 0 || where.start == then.start));
}

ActResult RunningSystem::come_back() {
    history_.reach(when(), system().now().seconds);
    const std::unique_ptr<Away> away = std::move(away_);
    history_.go_to(away->branch, history_.branches()[away->branch].size());
    const FileWatcher::Files seen = running_->live_reload ? running_->live_reload->seen() : FileWatcher::Files();
    trace_.take_over(away->trace);
    const std::unique_ptr<Running> before = replace(std::move(away->running));
    starts_ = away->starts;
    hash_before_ = away->hash_before;
    foreseen_.clear();
    differs_.reset();
    if (options_.watch) running_->live_reload.emplace(*this, *running_->reloads, running_->spec.files, seen);
    running_->system->log(LogLevel::info, "back in the present: other programs are connected again");
    return {};
}

const RunHistory& RunningSystem::history_until_now() {
    history_.reach(when(), system().now().seconds);
    return history_;
}

void RunningSystem::repeat(RunHistory past) {
    for (std::size_t index = 0; index < past.branches().front().size(); ++index) {
        const PastEvent& event = past.event(0, index);
        if (const auto* call = std::get_if<std::shared_ptr<const PastCall>>(&event.what))
            foreseen_.push_back({event.when.start, event.when.tick, (*call)->component, (*call)->call});
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
