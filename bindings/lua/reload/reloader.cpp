// Prepare all, adopt all, then commit all: the only step that changes anything, and the only one that can't fail.
#include "bindings/lua/reload/reloader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>

namespace nezumi {
namespace {

std::string normal(const std::string& path) {
    std::error_code problem;
    const auto full = std::filesystem::weakly_canonical(path, problem);
    return problem ? path : full.string();
}

bool contains(const std::vector<std::string>& all, const std::string& one) {
    return std::find(all.begin(), all.end(), one) != all.end();
}

Error still_running(Error error, const ScriptComponent& component) {
    error.message += fmt::format("; still running version {}", component.version());
    return error;
}

std::string list_of(const std::vector<std::string>& names) {
    constexpr std::size_t shown = 5;
    if (names.size() <= shown) return fmt::format("{}", fmt::join(names, ", "));
    return fmt::format("{} and {} more", fmt::join(names.begin(), names.begin() + shown, ", "), names.size() - shown);
}

}  // namespace

std::vector<ScriptComponent*> Reloader::scripts() const {
    std::vector<ScriptComponent*> all;
    for (const auto& component : system_.components()) {
        if (auto* script = dynamic_cast<ScriptComponent*>(component.get())) all.push_back(script);
    }
    return all;
}

std::vector<ScriptFile> Reloader::files() const {
    std::vector<ScriptFile> all = attempted_;
    std::ranges::copy(loaded_files(), std::back_inserter(all));
    return all;
}

std::vector<ScriptFile> Reloader::loaded_files() const {
    std::vector<ScriptFile> all;
    for (const ScriptComponent* component : scripts()) {
        all.push_back(component->script().file());
        const auto& modules = component->script().modules();
        all.insert(all.end(), modules.begin(), modules.end());
    }
    return all;
}

Expected<ActResult> Reloader::reload_files(const std::vector<std::string>& paths) {
    auto changes = changes_of(paths);
    if (!changes) return Unexpected(changes.error());
    return run(*changes);
}

Expected<std::vector<Reloader::Change>> Reloader::changes_of(const std::vector<std::string>& paths) const {
    std::vector<std::string> changed;
    changed.reserve(paths.size());
    for (const std::string& path : paths) changed.push_back(normal(path));
    std::map<std::string, SourceText> sources;
    std::vector<Change> changes;
    for (ScriptComponent* component : scripts()) {
        const Script& script = component->script();
        bool touched = contains(changed, normal(script.file().path));
        for (const ScriptFile& module : script.modules()) touched = touched || contains(changed, normal(module.path));
        if (!touched) continue;
        const auto [source, is_new] = sources.try_emplace(script.file().path);
        if (is_new) {
            auto text = read_(script.file().path);
            if (!text) return Unexpected(still_running(text.error(), *component));
            source->second = {text->path, script.file().shown, std::move(text->text)};
        }
        changes.emplace_back(component, source->second);
    }
    return changes;
}

Expected<Reloads::Rehearsal> Reloader::rehearsal(const std::vector<std::string>& paths) const {
    auto changes = changes_of(paths);
    if (!changes) return Unexpected(changes.error());
    std::vector<Part> parts;
    for (auto& [component, source] : *changes) {
        auto state = component->copy_state();
        if (!state) return Unexpected(still_running(state.error(), *component));
        Part part{.source = source,
                  .context = component->script().context(),
                  .parameters = component->parameters(),
                  .state = std::move(*state),
                  .running = component->version()};
        part.context.version = part.running + 1;
        parts.push_back(std::move(part));
    }
    return [parts = std::move(parts)] { return rehearse(parts); };
}

Expected<void> Reloader::rehearse(const std::vector<Part>& parts) {
    ChunkCache chunks;  // the system's own goes when it is started anew
    for (const Part& part : parts) {
        ScriptContext context = part.context;
        context.chunks = &chunks;
        auto script =
            Script::load(part.source, std::move(context), {.parameters = &part.parameters, .state = &part.state});
        if (script) continue;
        Error error = script.error();
        error.message += fmt::format("; still running version {}", part.running);
        return Unexpected(error);
    }
    return {};
}

Expected<ActResult> Reloader::reload(const SourceText& source) {
    const std::string file = normal(source.path);
    std::vector<Change> changes;
    for (ScriptComponent* other : scripts()) {
        if (normal(other->script().file().path) == file) changes.emplace_back(other, source);
    }
    return run(changes);
}

Expected<ActResult> Reloader::run(const std::vector<Change>& changes) {
    const Time& now = system_.now();
    std::vector<ScriptComponent::Version> next;
    for (const auto& [component, source] : changes) {
        const double limit = preparation_seconds_;
        const Budget budget = limit > 0 ? Budget{limit} : component->script().context().budget;
        attempted_.clear();
        auto prepared = component->prepare(source, budget, now, attempted_);
        if (!prepared) return Unexpected(still_running(prepared.error(), *component));
        next.push_back(std::move(*prepared));
    }
    attempted_.clear();
    for (std::size_t i = 0; i < changes.size(); ++i) {
        if (auto ok = changes[i].first->adopt(next[i], now); !ok)
            return Unexpected(still_running(ok.error(), *changes[i].first));
    }

    ActResult report;
    ++reloads_;
    for (std::size_t i = 0; i < changes.size(); ++i) {
        ScriptComponent& component = *changes[i].first;
        let_ports_go(component, next[i], report);
        component.commit(std::move(next[i]), reloads_);
        component.begin_probation();
        watch_probation(component);
        report.components.push_back(component.name());
    }
    if (!changes.empty()) report.version = changes.front().first->version();
    connect_again(report);
    finish(report, "");
    for (const auto& [component, source] : changes) {
        if (component->state() != LifeState::error) continue;
        // A fresh try; what fails is in the log, and the component is in ERROR as it was.
        if (component->reset(now)) static_cast<void>(component->activate(now));
    }
    return report;
}

void Reloader::let_ports_go(ScriptComponent& component, const ScriptComponent::Version& next, ActResult& report) {
    system_.change_layout();
    for (Port* port : component.ports_going(next)) {
        const std::string path = component.name() + "." + port->name();
        const bool in = port->direction() == Direction::in;
        std::vector<std::string> peers;
        for (System::Dropped& dropped : system_.disconnect_all(*port)) {
            peers.push_back(in ? dropped.from : dropped.to);
            lost_.push_back(std::move(dropped));
        }
        const auto& ports = next.script->ports();
        const auto successor =
            std::find_if(ports.begin(), ports.end(), [&](const PortDeclaration& d) { return d.name == port->name(); });
        std::string what = fmt::format("{} went", path);
        if (successor != ports.end() && successor->direction != port->direction()) {
            what = fmt::format("{} is an {} now", path, in ? "output" : "input");
        } else if (successor != ports.end()) {
            what = fmt::format("{} is {} now, not {}", path, message_type_names[successor->type], port->type_name());
        }
        report.notes.push_back(peers.empty() ? fmt::format("{}; it was not connected", what)
                                             : fmt::format("{}; it was connected to {}", what, fmt::join(peers, ", ")));
    }
}

// A port that is there again, after a slip or a rollback, gets back what it was connected to.
void Reloader::connect_again(ActResult& report) {
    std::erase_if(lost_, [&](const System::Dropped& lost) {
        const auto source = system_.port(lost.from);
        const auto sink = system_.port(lost.to);
        if (!source || !sink || (*source)->type() != (*sink)->type()) return false;
        if ((*source)->direction() != Direction::out || (*sink)->direction() != Direction::in) return false;
        if (system_.connect_again(lost))
            report.notes.push_back(fmt::format("{} is connected to {} again", lost.from, lost.to));
        return true;
    });
}

std::vector<Reloader::Group> Reloader::groups_of(const ActResult& report) const {
    std::vector<Group> groups;
    for (const std::string& name : report.components) {
        const Component& component = *system_.find(name);
        const std::string& file = component.script_file()->shown;
        auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& known) {
            return known.version == component.version() && known.file == file;
        });
        if (group == groups.end()) group = groups.insert(group, {file, component.version(), {}});
        group->components.push_back(name);
    }
    return groups;
}

void Reloader::finish(const ActResult& report, std::string_view what) {
    for (const Group& group : groups_of(report)) {
        system_.log(LogLevel::info, fmt::format("{}: version {} runs in {}", what.empty() ? group.file : what,
                                                group.version, list_of(group.components)));
    }
    for (const std::string& note : report.notes) system_.log(LogLevel::warn, note);
}

ActResult Reloader::go_back(int reload, bool keep_settings) {
    ActResult report;
    for (ScriptComponent* component : scripts()) {
        if (component->last_reload() != reload) continue;
        let_ports_go(*component, *component->version_before(), report);
        component->go_back(keep_settings);
        watch_probation(*component);
        report.components.push_back(component->name());
        report.version = component->version();
    }
    connect_again(report);
    return report;
}

Expected<ActResult> Reloader::rollback(const Component& component) {
    if (component.last_reload() == 0) {
        return failure(fmt::format("{} has no version before this one; still running version {}", component.name(),
                                   component.version()));
    }
    ActResult report = go_back(component.last_reload(), true);
    finish(report, "rollback");
    for (const std::string& name : report.components) {
        Component* each = system_.find(name);
        if (each->state() == LifeState::error && each->reset(system_.now()))
            static_cast<void>(each->activate(system_.now()));
    }
    return report;
}

void Reloader::watch_probation(const ScriptComponent& component) {
    if (component.on_probation() && !contains(on_probation_, component.name()))
        on_probation_.push_back(component.name());
}

void Reloader::after_tick() {
    if (on_probation_.empty()) return;
    struct Relapsed {
        std::vector<std::string> names;  // of components that failed alike
        ScriptComponent::Relapse what;
        ActResult report;
    };
    std::vector<Relapsed> all;
    for (const std::string& name : std::vector(on_probation_)) {
        auto* component = dynamic_cast<ScriptComponent*>(system_.find(name));
        if (component == nullptr) continue;
        for (ScriptComponent::Relapse& relapse : component->take_relapses()) {
            auto same = std::find_if(all.begin(), all.end(), [&](const Relapsed& each) {
                return each.what.reload == relapse.reload && each.what.version == relapse.version &&
                       each.what.execution == relapse.execution && each.what.error == relapse.error;
            });
            ActResult report = go_back(relapse.reload, false);
            if (relapse.went_back) report.components.insert(report.components.begin(), name);
            if (same == all.end()) same = all.insert(all.end(), {{}, std::move(relapse), {}});
            same->names.push_back(name);
            std::ranges::move(report.components, std::back_inserter(same->report.components));
            std::ranges::move(report.notes, std::back_inserter(same->report.notes));
        }
    }
    for (const Relapsed& each : all) {
        // Those that had gone back with another one have nothing left to go back to.
        std::vector<std::string> back;
        for (const Group& group :
             groups_of(each.report.components.empty() ? ActResult{.components = each.names} : each.report))
            back.push_back(fmt::format("version {} in {}", group.version, list_of(group.components)));
        system_.log(LogLevel::error,
                    fmt::format("{}: version {} failed in execution {} of its first {}: {}; back to {}",
                                list_of(each.names), each.what.version, each.what.execution, ScriptComponent::probation,
                                describe(each.what.error), fmt::join(back, " and ")));
        for (const std::string& note : each.report.notes) system_.log(LogLevel::warn, note);
    }
    std::erase_if(on_probation_, [this](const std::string& name) {
        const auto* component = dynamic_cast<ScriptComponent*>(system_.find(name));
        return component == nullptr || !component->on_probation();
    });
}

}  // namespace nezumi
