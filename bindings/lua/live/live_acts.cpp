// Performs acts on a live system: those that only the engine needs to know, and those on scripts and the specification.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "bindings/lua/live/live_system.hpp"
#include "bindings/lua/live/live_text.hpp"
#include "bindings/lua/live/rewire.hpp"
#include "bindings/lua/live/running.hpp"
#include "engine/system/perform.hpp"
#include "engine/system/rtm_wiring.hpp"

namespace nezumi {
namespace {

Expected<const Component*> behavior_named(System& system, std::string_view name) {
    const auto component = system.component(name);
    if (!component) return Unexpected(component.error());
    if ((*component)->script_file() != nullptr) return *component;
    return failure(fmt::format("{} has no script: only behaviours reload", name));
}

Expected<ActResult> result_of(const Expected<ReloadReport>& report) {
    if (!report) return Unexpected(report.error());
    ActResult result;
    result.components = report->components;
    result.version = report->version;
    result.notes = report->notes;
    return result;
}

}  // namespace

Expected<ActResult> LiveSystem::act(const Act& act, const Actor& who) {
    // What failed on probation is taken back before anything else happens, here as before a tick.
    running_->reloader->after_tick();
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
Expected<ActResult> LiveSystem::perform(const EngineAct& act, const Actor& who) {
    if constexpr (std::is_same_v<EngineAct, Connect> || std::is_same_v<EngineAct, Disconnect>)
        return rewire(*running_->system, running_->spec, act, who);
    return nezumi::perform(*running_->system, act, who);
}

Expected<ActResult> LiveSystem::perform(const Reload& act, const Actor& /*who*/) {
    Reloader& reloader = *running_->reloader;
    Expected<ReloadReport> report;
    if (!act.files.empty()) {
        report = reloader.reload_files(act.files);
    } else {
        const auto behavior = behavior_named(*running_->system, act.component);
        if (!behavior) return Unexpected(behavior.error());
        const ScriptFile& file = *(*behavior)->script_file();
        report = reloader.reload({file.path, act.shown.empty() ? file.shown : act.shown, act.text});
    }
    if (report) watch_again();
    if (!report && report.error().kind == Error::Kind::out_of_time && options_.build.out_of_time_is_fatal)
        running_->system->fail(report.error());
    return result_of(report);
}

Expected<ActResult> LiveSystem::perform(const Rollback& act, const Actor& /*who*/) {
    const auto behavior = behavior_named(*running_->system, act.component);
    if (!behavior) return Unexpected(behavior.error());
    const auto report = running_->reloader->rollback(**behavior);
    if (report) watch_again();
    return result_of(report);
}

Expected<ActResult> LiveSystem::add(PreparedAdd prepared, const Actor& who) {
    if (prepared.start != starts_) return failure("the system was started anew while this was read: say it again");
    const Add same{prepared.given};
    prepared_ = std::move(prepared);
    auto added = act(same, who);
    prepared_.reset();
    return added;
}

Expected<ActResult> LiveSystem::perform(const Add& act, const Actor& /*who*/) {
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
    if (prepared.chunks) running_->chunks.take(*prepared.chunks);
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
    running_->prepared = std::move(prepared.behavior);
    auto added = add_entry(*running_->system, prepared.entry, spec, running_->makers);
    running_->prepared.reset();
    if (!added) return Unexpected(added.error());
    spec.entries.push_back(std::move(prepared.entry));
    watch_again();
    return ActResult{};
}

Expected<ActResult> LiveSystem::perform(const Remove& act, const Actor& /*who*/) {
    System& system = *running_->system;
    const auto component = system.component(act.component);
    if (!component) return Unexpected(component.error());
    if (const auto* robot = dynamic_cast<const Robot*>(*component); robot != nullptr && robot->is_real())
        return failure(fmt::format("{} is a real robot: it stays until the run ends", act.component));
    for (const Entry& entry : running_->spec.entries) {
        const auto* carried = std::get_if<ComponentEntry>(&entry);
        if (carried != nullptr && carried->on == act.component)
            return failure(fmt::format("{} carries {}: remove that first", act.component, carried->name));
    }
    ActResult result;
    const auto note = [&](const auto& ports) {
        for (const auto& port : ports) {
            const auto peers = peers_of(*this, **component, *port);
            if (!peers.empty())
                result.notes.push_back(
                    fmt::format("{}.{} was connected to {}", act.component, port->name(), fmt::join(peers, ", ")));
        }
    };
    note((*component)->in_ports());
    note((*component)->out_ports());
    if (auto gone = system.remove(act.component); !gone) return Unexpected(gone.error());
    std::erase_if(running_->spec.entries, [&](const Entry& entry) { return name_of(entry) == act.component; });
    forget_rtm(running_->spec, act.component);
    watch_again();
    return result;
}

Expected<ActResult> LiveSystem::perform(const MoveMarker& act, const Actor& who) {
    auto moved = nezumi::perform(*running_->system, act, who);
    if (!moved) return moved;
    for (MarkerSpec& marker : running_->spec.arena.markers) {
        if (marker.name != act.marker) continue;
        marker.at = act.pose.position;
        marker.facing = act.pose.orientation.y;
    }
    return moved;
}

Expected<ActResult> LiveSystem::perform(const MoveThing& act, const Actor& who) {
    auto moved = nezumi::perform(*running_->system, act, who);
    if (moved) move_thing(running_->spec.arena, act.thing, act.pose);
    return moved;
}

Expected<ActResult> LiveSystem::perform(const AddMarker& act, const Actor& who) {
    auto added = nezumi::perform(*running_->system, act, who);
    if (added) running_->spec.arena.markers.push_back(act.marker);
    return added;
}

Expected<ActResult> LiveSystem::perform(const RemoveMarker& act, const Actor& who) {
    auto gone = nezumi::perform(*running_->system, act, who);
    if (gone) std::erase_if(running_->spec.arena.markers, [&](const auto& each) { return each.name == act.marker; });
    return gone;
}

}  // namespace nezumi
