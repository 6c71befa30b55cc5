// Performs acts on a running system: those of perform.hpp, and those on scripts, entries and the whole system.
#include <cassert>
#include <utility>

#include "engine/base/list.hpp"
#include "engine/live/past_run.hpp"
#include "engine/live/prepare.hpp"
#include "engine/live/running.hpp"
#include "engine/live/running_system.hpp"
#include "engine/system/perform.hpp"
#include "engine/system/perform_on_spec.hpp"

namespace nezumi {

Expected<ActResult> RunningSystem::act(const Act& act, const Actor& who) {
    if (takes_files(act)) {
        settle();
        return commit(prepare(act)(), who);
    }
    if (const auto* seek = std::get_if<Seek>(&act); seek != nullptr && has_peers() && begin_seek(*seek))
        leave_peers(who);
    return perform_and_tell(act, who, nullptr, [&] {
        return std::visit([&](const auto& each) { return perform(each, who, nullptr); }, act);
    });
}

Expected<ActResult> RunningSystem::act_again(const Act& act, const Actor& who) {
    std::string refusal = std::exchange(refusal_, {});
    auto done = this->act(act, who);
    refusal_ = std::move(refusal);
    return done;
}

Expected<ActResult> RunningSystem::deliver(const Port& port, const Act& act, const Actor& who) {
    // Callers have only a const system, so that they change it only through acts. This is such an act.
    return perform_and_tell(act, who, nullptr, [&] { return nezumi::deliver(const_cast<Port&>(port), act); });
}

Preparation RunningSystem::prepare(const Act& act, FilesSeen found) const {
    PreparingWork work;
    if (const auto* reload = std::get_if<Reload>(&act)) work = work_of(*reload, *this, *running_->reloads);
    if (const auto* add = std::get_if<Add>(&act)) work = work_of(*add, *this);
    if (const auto* restart = std::get_if<Restart>(&act)) work = work_of(*restart, *this);
    assert(work);
    return [act, generation = generation_, project = project_, found = std::move(found), work = std::move(work)] {
        PreparedAct prepared{.act = act, .generation = generation};
        FileSnapshot files(project.files(), found);
        work(prepared, project.through(files));
        prepared.files = files.take();
        return prepared;
    };
}

bool RunningSystem::fits(const PreparedAct& prepared) const {
    return prepared.generation == generation_ &&
           (prepared.reload == nullptr || running_->reloads->fits(*prepared.reload));
}

Expected<ActResult> RunningSystem::commit(PreparedAct prepared, const Actor& who) {
    return perform_and_tell(prepared.act, who, &prepared.files, [&]() -> Expected<ActResult> {
        if (auto ok = check(prepared); !ok) return Unexpected(ok.error());
        return std::visit([&](const auto& each) { return perform(each, who, &prepared); }, prepared.act);
    });
}

void RunningSystem::settle() {
    // A script that failed on probation is rolled back before anything else, as before a tick.
    running_->reloads->after_tick();
    if (!foreseen_.empty()) take_foreseen();
}

template <class Perform>
Expected<ActResult> RunningSystem::perform_and_tell(const Act& act, const Actor& who, FilesSeen* files,
                                                    const Perform& perform) {
    if (!refusal_.empty()) return failure(refusal_);
    settle();
    const ActTime time = when();
    auto done = perform();
    ++acts_;
    if (repeats_) return done;
    const auto past =
        std::make_shared<const PastAct>(PastAct{act, who, !done, files != nullptr ? std::move(*files) : FilesSeen()});
    const bool is_seek = std::holds_alternative<Seek>(act);
    if (is_of_history(act, done.has_value()) && !is_seek) history_.add({time, past});
    if (act_observer_ != nullptr) act_observer_->acted(time, past, done);
    if (!is_seek) tell_out_of_time(std::holds_alternative<Restart>(act) ? when() : time);
    return done;
}

Expected<ActResult> RunningSystem::commit(PastRun& past, const Actor& who) {
    if (has_peers() && past.generation() == generation_) leave_peers(who);
    return perform_and_tell(past.where(), who, nullptr, [&] { return take(past); });
}

Expected<void> RunningSystem::check(const PreparedAct& prepared) const {
    if (!fits(prepared)) return failure("the system has changed while the files were read: try again");
    for (const std::string& line : prepared.printed) {
        if (options_.print) options_.print(line);
    }
    return prepared.error ? Unexpected(*prepared.error) : Expected<void>();
}

template <class EngineAct>
Expected<ActResult> RunningSystem::perform(const EngineAct& act, const Actor& who, PreparedAct* /*prepared*/) {
    if constexpr (requires { perform_on_spec(*running_->system, running_->spec, act, who); }) {
        return perform_on_spec(*running_->system, running_->spec, act, who);
    } else {
        return nezumi::perform(*running_->system, act, who);
    }
}

Expected<ActResult> RunningSystem::perform(const Reload& /*act*/, const Actor& /*who*/, PreparedAct* prepared) {
    FileSnapshot files(project_.files(), std::move(prepared->files));
    auto report = running_->reloads->commit(*prepared->reload, project_.through(files));
    prepared->files = files.take();
    if (report) watch_again();
    if (!report && report.error().kind == Error::Kind::out_of_time && options_.build.out_of_time_is_fatal)
        running_->system->fail(report.error());
    return report;
}

Expected<ActResult> RunningSystem::perform(const Rollback& act, const Actor& /*who*/, PreparedAct* /*prepared*/) {
    if (const auto script = script_of(*running_->system, act.component); !script) return Unexpected(script.error());
    auto report = running_->reloads->rollback(*running_->system->find(act.component));
    if (report) watch_again();
    return report;
}

Expected<ActResult> RunningSystem::perform(const Add& act, const Actor& who, PreparedAct* prepared) {
    SystemSpec& spec = running_->spec;
    SystemSpec& part = prepared->spec;
    const auto* robot = std::get_if<RobotEntry>(&act.entry);
    for (auto& [name, model] : part.models) {
        const bool is_its_own = robot != nullptr && name != robot->described_by();
        if (is_its_own) {
            spec.models.insert_or_assign(name, std::move(model));
        } else {
            spec.models.emplace(name, std::move(model));
        }
    }
    for (const std::string& file : part.files) {
        add_once(spec.files, file);
    }
    running_->behaviors->take_all(*prepared->behaviors);
    auto added = add_entry(*running_->system, part.entries.front(), spec, running_->makers);
    if (!added) return Unexpected(added.error());
    spec.entries.push_back(std::move(part.entries.front()));
    note_added(*running_->system, spec, (*added)->name(), who, running_->makers);
    watch_again();
    return ActResult{};
}

Expected<ActResult> RunningSystem::perform(const Remove& act, const Actor& who, PreparedAct* /*prepared*/) {
    auto gone = perform_on_spec(*running_->system, running_->spec, act, who);
    if (gone) watch_again();
    return gone;
}

Expected<ActResult> RunningSystem::perform(const Restart& /*act*/, const Actor& /*who*/, PreparedAct* prepared) {
    FileSnapshot files(project_.files(), std::move(prepared->files));
    auto next = build(std::move(prepared->spec), std::move(prepared->behaviors), files);
    prepared->files = files.take();
    if (!next) return Unexpected(next.error());
    hash_before_ = trace_hash();
    away_.reset();
    take(std::move(*next));
    activate();
    return ActResult{};
}

}  // namespace nezumi
