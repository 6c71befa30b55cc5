// Loads all versions while ticks go on. Then adopts all and commits all; only the commit changes anything, and it
// can't fail.
#include "bindings/lua/reload/reloader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "bindings/lua/script/behavior_maker.hpp"
#include "engine/base/list.hpp"

namespace nezumi {
namespace {

std::string normal(const std::string& path) {
    std::error_code problem;
    const auto full = std::filesystem::weakly_canonical(path, problem);
    return problem ? path : full.string();
}

Error still_running(Error error, int version) {
    error.message += fmt::format("; still running version {}", version);
    return error;
}

std::string list_of(const std::vector<std::string>& names) {
    constexpr std::size_t shown = 5;
    if (names.size() <= shown) return fmt::format("{}", fmt::join(names, ", "));
    return fmt::format("{} and {} more", fmt::join(names.begin(), names.begin() + shown, ", "), names.size() - shown);
}

// The robot that this behaviour drives, if the robot is moving; otherwise null.
const Robot* robot_that_it_moves(const System& system, const Component& component) {
    for (const Robot* robot : system.robots()) {
        const ScriptedBody* body = robot->scripted_body();
        if (body != nullptr && body->needs(component) && !robot->stands()) return robot;
    }
    return nullptr;
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

// A behaviour and its next version.
struct Reloader::Next {
    std::string name;
    int running = 0;  // number of the running version
    std::vector<std::string> paths;
    ScriptComponent::Loading loading;
};

struct Reloader::Prepared final : PreparedReload {
    std::vector<std::pair<std::string, int>> running;  // every behaviour with its running version
    explicit Prepared(Coverage* coverage) : chunks(coverage) {}
    ChunkCache chunks;  // code of `scripts`
    std::vector<Next> next;
    std::vector<std::unique_ptr<Script>> scripts;  // in the order of `next`
    std::vector<ScriptFile> required;              // modules that the last of `scripts` requires
    std::optional<Error> error;

    // Loads the behaviours of these files, or without files the one of `source`.
    void load(std::vector<Next> all, std::vector<std::string> files, const SourceText& source, const Project& project);
};

void Reloader::Prepared::load(std::vector<Next> all, std::vector<std::string> files, const SourceText& source,
                              const Project& project) {
    for (std::string& file : files) file = normal(file);
    const std::string replaced = files.empty() ? normal(source.path) : "";
    std::map<std::string, Expected<SourceText>> texts;
    for (Next& each : all) {
        running.emplace_back(each.name, each.running);
        const std::string own = each.paths.front();
        const bool touched =
            files.empty()
                ? normal(own) == replaced
                : std::ranges::any_of(each.paths, [&](const auto& path) { return contains(files, normal(path)); });
        if (!touched || error) continue;
        if (!files.empty()) {
            const auto text = texts.try_emplace(own, project.read_source(own)).first->second;
            if (!text) {
                error = still_running(text.error(), each.running);
                continue;
            }
            each.loading.source.text = text->text;
        } else {
            each.loading.source = source;
        }
        each.loading.context.find_module = modules_of(project);
        each.loading.context.find_message = messages_of(project);
        each.loading.context.chunks = &chunks;
        required.clear();
        auto script = ScriptComponent::load_beside(each.loading, required);
        if (!script) error = still_running(script.error(), each.running);
        scripts.push_back(script ? std::move(*script) : nullptr);
        each.loading.context.find_module = {};
        each.loading.context.find_message = {};
        next.push_back(std::move(each));
    }
}

Reloads::Loader Reloader::loader() const {
    std::vector<Next> all;
    for (const ScriptComponent* component : scripts()) {
        const Script& script = component->script();
        Next& next = all.emplace_back(
            Next{component->name(), component->version(), {script.file().path}, component->next_loading()});
        for (const ScriptFile& module : script.modules()) next.paths.push_back(module.path);
        next.loading.source = {script.file().path, script.file().shown, ""};
        next.loading.context.seconds = system_.now().seconds;
    }
    return [all = std::move(all), coverage = chunks_.coverage()](const std::vector<std::string>& files,
                                                                 const SourceText& source, const Project& project) {
        auto prepared = std::make_unique<Prepared>(coverage);
        prepared->load(all, files, source, project);
        return prepared;
    };
}

bool Reloader::fits(const PreparedReload& prepared) const {
    const auto is_same = [](const auto& before, const ScriptComponent* now) {
        return before.first == now->name() && before.second == now->version();
    };
    return std::ranges::equal(static_cast<const Prepared&>(prepared).running, scripts(), is_same);
}

Expected<ActResult> Reloader::commit(PreparedReload& loaded, const Project& project) {
    auto& prepared = static_cast<Prepared&>(loaded);
    attempted_ = std::move(prepared.required);
    if (prepared.error) return Unexpected(*prepared.error);
    const Time& now = system_.now();
    struct Change {
        ScriptComponent& component;
        ScriptComponent::Version next;
    };
    std::vector<Change> changes;
    for (std::size_t i = 0; i < prepared.next.size(); ++i) {
        ScriptComponent& component = *dynamic_cast<ScriptComponent*>(system_.find(prepared.next[i].name));
        if (const Robot* robot = robot_that_it_moves(system_, component)) {
            return Unexpected(
                still_running(Error{fmt::format("{} drives '{}', which moves: reload it when the robot stands still",
                                                component.name(), robot->name()),
                                    {}},
                              component.version()));
        }
        ScriptComponent::Loading& loading = prepared.next[i].loading;
        loading.context.find_module = modules_of(project);
        loading.context.find_message = messages_of(project);
        attempted_.clear();
        auto next = component.prepare(loading, std::move(prepared.scripts[i]), now, attempted_);
        if (!next) return Unexpected(still_running(next.error(), component.version()));
        changes.push_back({component, std::move(*next)});
    }
    attempted_.clear();
    for (Change& change : changes) {
        if (auto ok = change.component.adopt(change.next, now); !ok)
            return Unexpected(still_running(ok.error(), change.component.version()));
    }

    ActResult report;
    ++reloads_;
    chunks_.take(prepared.chunks);
    const std::size_t first_lost = lost_.size();
    for (Change& change : changes) {
        ScriptComponent& component = change.component;
        change.next.script->share(&chunks_);
        let_ports_go(component, change.next, first_lost, report);
        component.commit(std::move(change.next), reloads_);
        component.begin_probation();
        watch_probation(component);
        report.components.push_back(component.name());
    }
    if (!changes.empty()) report.version = changes.front().component.version();
    connect_again(report);
    finish(report, "");
    for (const Change& change : changes) {
        if (change.component.state() != LifeState::error) continue;
        // Tries again. If this fails, the log has the error, and the component stays in ERROR.
        if (change.component.reset(now)) static_cast<void>(change.component.activate(now));
    }
    return report;
}

void Reloader::let_ports_go(ScriptComponent& component, const ScriptComponent::Version& next, std::size_t first_lost,
                            ActResult& report) {
    system_.change_layout();
    for (Port* port : component.ports_going(next)) {
        const std::string path = component.name() + "." + port->name();
        const bool in = port->direction() == Direction::in;
        for (System::Dropped& dropped : system_.disconnect_all(*port)) lost_.push_back(std::move(dropped));
        // Includes the connections that this reload has already removed together with the port at their other end.
        std::vector<std::string> peers;
        for (std::size_t i = first_lost; i < lost_.size(); ++i) {
            if ((in ? lost_[i].to : lost_[i].from) == path) peers.push_back(in ? lost_[i].from : lost_[i].to);
        }
        const auto& ports = next.script->ports();
        const auto successor =
            std::find_if(ports.begin(), ports.end(), [&](const PortDeclaration& d) { return d.name == port->name(); });
        std::string what = fmt::format("{} was removed", path);
        if (successor != ports.end() && successor->direction != port->direction()) {
            what = fmt::format("{} is an {} now", path, in ? "output" : "input");
        } else if (successor != ports.end()) {
            what = successor->type->name == port->type_name()
                       ? fmt::format(
                             "{}: the definition of {} has changed{}", path, port->type_name(),
                             in && static_cast<const InPortBase*>(port)->is_new() ? "; unread values are dropped" : "")
                       : fmt::format("{} is {} now, not {}", path, successor->type->name, port->type_name());
        }
        report.notes.push_back(peers.empty() ? fmt::format("{}; it was not connected", what)
                                             : fmt::format("{}; it was connected to {}", what, fmt::join(peers, ", ")));
    }
}

// A port that exists again, after a mistake or a rollback, gets back its connections.
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
    const std::size_t first_lost = lost_.size();
    for (ScriptComponent* component : scripts()) {
        if (component->last_reload() != reload) continue;
        let_ports_go(*component, *component->version_before(), first_lost, report);
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
        std::vector<std::string> names;  // of components with the same failure
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
        // Components that went back together with another one have no version to go back to.
        std::vector<std::string> back;
        for (const Group& group :
             groups_of(each.report.components.empty() ? ActResult{.components = each.names} : each.report))
            back.push_back(fmt::format("version {} in {}", group.version, list_of(group.components)));
        system_.log(LogLevel::error,
                    fmt::format("{}: version {} failed in its execution {} (of the first {}): {}; back to {}",
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
