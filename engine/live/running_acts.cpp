// Performs acts on a running system: those of perform.hpp, and those on scripts, entries and the whole.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/live/running.hpp"
#include "engine/live/running_system.hpp"
#include "engine/system/perform.hpp"
#include "engine/system/perform_on_spec.hpp"
#include "engine/system/rtm_wiring.hpp"

namespace nezumi {
namespace {

Expected<const Component*> behavior_named(System& system, std::string_view name) {
    const auto component = system.component(name);
    if (!component) return Unexpected(component.error());
    if ((*component)->script_file() != nullptr) return *component;
    return failure(fmt::format("{} has no script: only behaviours reload", name));
}

}  // namespace

Expected<ActResult> RunningSystem::act(const Act& act, const Actor& who) {
    // What failed on probation is taken back before anything else happens, here as before a tick.
    running_->reloads->after_tick();
    if (!foreseen_.empty()) take_foreseen();
    const ActTime time = when();
    auto result = std::visit([&](const auto& each) { return perform(each, who); }, act);
    ++acts_;
    if (act_observer_ != nullptr) {
        act_observer_->acted(time, act, who, result);
        tell_out_of_time(std::holds_alternative<Restart>(act) ? when() : time);
    }
    return result;
}

template <class EngineAct>
Expected<ActResult> RunningSystem::perform(const EngineAct& act, const Actor& who) {
    if constexpr (requires { perform_on_spec(*running_->system, running_->spec, act, who); }) {
        return perform_on_spec(*running_->system, running_->spec, act, who);
    } else {
        return nezumi::perform(*running_->system, act, who);
    }
}

Expected<ActResult> RunningSystem::perform(const Reload& act, const Actor& /*who*/) {
    Expected<ActResult> report;
    if (!act.files.empty()) {
        report = running_->reloads->reload_files(act.files);
    } else {
        const auto behavior = behavior_named(*running_->system, act.component);
        if (!behavior) return Unexpected(behavior.error());
        const ScriptFile& file = *(*behavior)->script_file();
        report = running_->reloads->reload({file.path, act.shown.empty() ? file.shown : act.shown, act.text});
    }
    if (report) watch_again();
    if (!report && report.error().kind == Error::Kind::out_of_time && options_.build.out_of_time_is_fatal)
        running_->system->fail(report.error());
    return report;
}

Expected<ActResult> RunningSystem::perform(const Rollback& act, const Actor& /*who*/) {
    const auto behavior = behavior_named(*running_->system, act.component);
    if (!behavior) return Unexpected(behavior.error());
    auto report = running_->reloads->rollback(**behavior);
    if (report) watch_again();
    return report;
}

Expected<ActResult> RunningSystem::add(PreparedAdd prepared, const Actor& who) {
    if (prepared.start != starts_) return failure("the system was started anew while this was read: say it again");
    const Add same{prepared.given};
    prepared_ = std::move(prepared);
    auto added = act(same, who);
    prepared_.reset();
    return added;
}

Expected<ActResult> RunningSystem::perform(const Add& act, const Actor& /*who*/) {
    SystemSpec& spec = running_->spec;
    const auto* robot = std::get_if<RobotEntry>(&act.entry);
    if (options_.build.real_time && robot != nullptr)
        return failure(fmt::format("robot '{}': with --hw all robots are there from the start", name_of(act.entry)));
    if (!prepared_) {
        SystemSpec part;
        part.file = spec.file;
        if (robot != nullptr && spec.models.contains(robot->described_by()))
            part.models.emplace(robot->described_by(), spec.models.at(robot->described_by()));
        auto prepared = add_preparer().here(act.entry, std::move(part));
        if (!prepared) return Unexpected(prepared.error());
        prepared_ = std::move(*prepared);
    }
    PreparedAdd prepared = *std::exchange(prepared_, std::nullopt);
    project_.files().adopt(prepared.seen);
    for (auto& [name, model] : prepared.models) {
        const bool is_its_own = robot != nullptr && name != robot->described_by();
        if (is_its_own) {
            spec.models.insert_or_assign(name, std::move(model));
        } else {
            spec.models.emplace(name, std::move(model));
        }
    }
    for (const std::string& file : prepared.files) {
        if (std::find(spec.files.begin(), spec.files.end(), file) == spec.files.end()) spec.files.push_back(file);
    }
    if (prepared.behavior) running_->prepared = prepared.behavior->take();
    auto added = add_entry(*running_->system, prepared.entry, spec, running_->makers);
    running_->prepared.reset();
    if (!added) return Unexpected(added.error());
    spec.entries.push_back(std::move(prepared.entry));
    watch_again();
    return ActResult{};
}

Expected<ActResult> RunningSystem::perform(const Remove& act, const Actor& who) {
    auto gone = perform_on_spec(*running_->system, running_->spec, act, who);
    if (gone) watch_again();
    return gone;
}

}  // namespace nezumi
