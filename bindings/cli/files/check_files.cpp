// Checks each file by the reader that would load it.
#include "bindings/cli/files/check_files.hpp"

#include <algorithm>
#include <functional>
#include <set>
#include <system_error>
#include <utility>

#include "bindings/cli/files/named_files.hpp"
#include "bindings/dds/network_maker.hpp"
#include "bindings/learning/environment_file.hpp"
#include "bindings/lua/files/calibration_file.hpp"
#include "bindings/lua/files/message_file.hpp"
#include "bindings/lua/files/robot_file.hpp"
#include "bindings/lua/files/system_file.hpp"
#include "bindings/lua/files/system_lua.hpp"
#include "bindings/lua/sandbox/compile.hpp"
#include "bindings/lua/sandbox/stdlib.hpp"
#include "bindings/lua/script/behavior_maker.hpp"
#include "bindings/lua/script/check_script.hpp"
#include "bindings/lua/script/script_component.hpp"
#include "bindings/scenario/scenario_file.hpp"
#include "engine/base/list.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/system/peer_word.hpp"
#include "engine/system/script_drivers.hpp"

namespace nezumi::cli {
namespace {

namespace fs = std::filesystem;

constexpr int most_errors = 50;  // per system: each error needs a further build

// Reads a script. Messages name the script by its path, so that an editor can open it.
Expected<SourceText> read_shown(const fs::path& path, const Project& project) {
    const std::string name = project.shown(path);
    auto text = read_whole(path, name);
    if (!text) return Unexpected(text.error());
    return SourceText{path.string(), name, std::move(*text)};
}

ScriptContext context_of(const std::string& component, const Project& project) {
    ScriptContext context;
    context.component = component;
    context.budget = headless_budget;
    context.find_module = [&project](std::string_view name, std::string_view from) -> Expected<SourceText> {
        const auto path = project.find(FileKind::module, name, from);
        if (!path) return Unexpected(path.error());
        return read_shown(*path, project);
    };
    context.find_message = messages_of(project);
    return context;
}

// True if an entry, or one of the entry's values, is at this location.
bool stands_at(const Entry& entry, const Place& place) {
    if (place_of(entry) == place) return true;
    return std::visit(
        [&](const auto& its) {
            if constexpr (requires { its.places; }) {
                return std::any_of(its.places.begin(), its.places.end(),
                                   [&](const auto& value) { return value.second == place; });
            } else {
                return false;
            }
        },
        entry);
}

// Removes from a system the entry of an error, and everything that needs the entry, so that a further build finds
// further errors. Returns false if nothing is at this location.
bool leave_out(SystemSpec& spec, const Project& project, const Place& place) {
    if (std::erase_if(spec.connections, [&](const ConnectionSpec& c) { return c.place == place; }) > 0) return true;
    const auto peers = spec.peers;  // a copy: `remove_at` may change `spec.peers`
    for (const auto& [name, peer] : peers) {
        if (peer->word().remove_at(spec, place)) return true;
    }
    std::set<std::string, std::less<>> gone;
    for (const Entry& entry : spec.entries) {
        const auto* behavior = std::get_if<BehaviorEntry>(&entry);
        const auto* component = std::get_if<ComponentEntry>(&entry);
        if (stands_at(entry, place) || (behavior != nullptr && project.shown(behavior->path) == place.file) ||
            (component != nullptr && gone.contains(component->on))) {
            gone.insert(name_of(entry));
        }
    }
    std::erase_if(spec.entries, [&](const Entry& entry) { return gone.contains(name_of(entry)); });
    std::erase_if(spec.connections, [&](const ConnectionSpec& c) {
        return gone.contains(c.from.substr(0, c.from.find('.'))) || gone.contains(c.to.substr(0, c.to.find('.')));
    });
    return !gone.empty();
}

// For a build without simulation: gives robots no bodies. None is needed, because a checked system never runs.
void leave_out_bodies(SystemSpec& spec, Makers& makers) {
    const std::string none = "none";
    makers.bodies[none] = [](const RobotEntry& /*entry*/, const RobotSpec& /*spec*/) { return nullptr; };
    for (RobotEntry* robot : entries_of<RobotEntry>(spec)) {
        if (!robot->is_real()) robot->backend = none;
    }
}

std::vector<Error> check_system(const std::string& text, const std::string& shown, const Project& project,
                                const LiveOptions& options) {
    if (auto errors = check_system_text(text, shown, project, {.peer_words = options.peer_words}); !errors.empty()) {
        for (Error& error : errors) error = explain_system_error(std::move(error));
        return errors;
    }
    auto spec = read_system_text(text, shown, project, {.peer_words = options.peer_words});
    if (!spec) return {spec.error()};
    Makers makers;
    makers.world = options.world;
    makers.bodies = options.bodies;
    makers.drivers = options.drivers;
    makers.components = options.components;
    makers.peer_words = options.peer_words;
    makers.network = dds::make_checked_networks();
    if (auto ok = add_script_drivers(*spec); !ok) return {ok.error()};
    if (!makers.world) leave_out_bodies(*spec, makers);
    std::vector<Error> errors;
    const auto add = [&errors](Error error) { add_once(errors, std::move(error)); };
    makers.behavior = [&](const BehaviorEntry& entry,
                          const MakerContext& maker) -> Expected<std::unique_ptr<Component>> {
        auto source = read_shown(entry.path, project);
        if (!source) return Unexpected(source.error());
        ScriptContext context = context_of(entry.name, project);
        context.configured = values_at_start(entry);
        context.tick_rate = maker.tick_rate;
        for (Error& error : check_behavior(*source, context)) add(std::move(error));
        auto made = ScriptComponent::load(entry.name, *source, std::move(context));
        if (!made) return Unexpected(made.error());
        return std::unique_ptr<Component>(std::move(*made));
    };
    for (int i = 0; i < most_errors; ++i) {
        const auto built = build_system(*spec, makers, options.build);
        if (built) {
            for (const auto& [word, peers] : spec->peers) {
                if (auto ok = peers->word().check_built(**built, *peers); !ok) errors.push_back(ok.error());
            }
            break;
        }
        add(built.error());
        if (!leave_out(*spec, project, built.error().place)) break;
    }
    return errors;
}

// Checks a text by compiling it, without running it. The text may use the globals `words`.
std::vector<Error> check_words(const std::string& text, const std::string& shown,
                               const std::vector<std::string_view>& words) {
    KnownGlobals known = sandbox_globals();
    known.readable.insert(known.readable.end(), words.begin(), words.end());
    known.readable.emplace_back("require");
    auto chunk = compile_checked(text, shown, known);
    return chunk ? std::vector<Error>() : std::move(chunk.error());
}

// Declares the scenarios without running any.
std::vector<Error> check_scenarios(const fs::path& file, const std::string& text, const LiveOptions& options) {
    std::vector<Error> errors;
    static_cast<void>(ScenarioFile::read(
        file, {.installed = options.installed, .peer_words = options.peer_words, .text = text}, &errors));
    return errors;
}

std::vector<Error> check_calibration(const std::string& text, const std::string& shown, const Project& project) {
    auto calibration = read_calibration_text(text, shown, project);
    return calibration ? std::vector<Error>() : std::vector<Error>{std::move(calibration.error())};
}

// Reads the description of the environment, and finds its system, without running either.
std::vector<Error> check_environment(const SourceText& source, const Project& project) {
    std::vector<Error> errors;
    const auto file = EnvironmentFile::read(source, project, 0, {}, &errors);
    if (!file) return errors;
    const auto system = (*file)->find_system(project);
    return system ? errors : std::vector<Error>{system.error()};
}

// Checks the message types that a file defines, and the types of their fields.
std::vector<Error> check_message(const SourceText& source, const Project& project) {
    const auto types = MessageFiles(project, read_message_file).types_in(source);
    return types ? std::vector<Error>() : std::vector<Error>{types.error()};
}

}  // namespace

std::vector<Error> check_file(const fs::path& file, const LiveOptions& options) {
    const std::string shown = Project::of(file, options.installed).shown(file);
    const auto text = read_whole(file, shown);
    return text ? check_text(*text, file, options) : std::vector<Error>{text.error()};
}

std::vector<Error> check_text(const std::string& text, const fs::path& file, const LiveOptions& options) {
    const Project project = Project::of(file, options.installed);
    const std::string shown = project.shown(file);
    const SourceText source{file.string(), shown, text};
    if (file.extension() == ".msg" || file.extension() == ".idl") return check_message(source, project);
    switch (kind_of_file(file, text)) {
        case LuaKind::behavior: return check_behavior(source, context_of(type_of_file(shown), project));
        case LuaKind::module: return check_module(source);
        case LuaKind::system_module: return check_words(text, shown, system_word_names(options.peer_words));
        case LuaKind::system: return check_system(text, shown, project, options);
        case LuaKind::calibration: return check_calibration(text, shown, project);
        case LuaKind::robot: return check_robot_text(text, shown, project, options.drivers);
        case LuaKind::scenario: return check_scenarios(file, text, options);
        case LuaKind::message: return check_message(source, project);
        case LuaKind::environment: return check_environment(source, project);
        case LuaKind::definitions: break;
    }
    const auto chunk = compile(text, shown);
    return chunk ? std::vector<Error>() : std::vector<Error>{chunk.error()};
}

FoundFiles lua_files(const std::vector<std::string>& paths) {
    FoundFiles all;
    std::set<fs::path> known;
    const auto add = [&](const fs::path& file) {
        std::error_code none;
        if (known.insert(fs::weakly_canonical(file, none)).second) all.files.push_back(file);
    };
    for (const std::string& path : paths) {
        const auto refuse = [&](std::string why) { all.errors.push_back({std::move(why), {path}}); };
        std::error_code none;
        if (fs::is_directory(path, none)) {
            FoundFiles below = find_files(path, ".lua");
            if (below.files.empty() && below.errors.empty()) refuse("has no Lua files");
            for (const fs::path& file : below.files) add(file);
            for (Error& error : below.errors) all.errors.push_back(std::move(error));
        } else if (!fs::exists(path, none)) {
            auto found = find_lua_files(path);
            if (found) {
                std::for_each(found->begin(), found->end(), add);
            } else {
                all.errors.push_back(found.error());
            }
        } else if (const fs::path ending = fs::path(path).extension();
                   ending != ".lua" && ending != ".msg" && ending != ".idl") {
            refuse("is not a Lua file: `nezumi check` reads files that end in .lua, .msg or .idl, and folders");
        } else {
            add(path);
        }
    }
    return all;
}

}  // namespace nezumi::cli
