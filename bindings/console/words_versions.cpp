// Words for versions of scripts, and for keeping what a session has made.
#include <fmt/format.h>

#include "bindings/console/save_system.hpp"
#include "bindings/console/words.hpp"
#include "bindings/lua/script/script_component.hpp"

namespace nezumi {
namespace {

std::string report_text(const System& system, const ReloadReport& report) {
    std::string text;
    for (const std::string& name : report.components) {
        const Component* component = system.find(name);
        if (component == nullptr) continue;
        text += fmt::format("{}{}: version {} runs", text.empty() ? "" : "\n", name, component->version());
    }
    for (const std::string& note : report.notes) text += "\n" + note;
    return text;
}

// The component whose version came last.
ScriptComponent* changed_last(const System& system) {
    ScriptComponent* last = nullptr;
    for (const auto& component : system.components()) {
        auto* script = dynamic_cast<ScriptComponent*>(component.get());
        if (script == nullptr || script->version_before() == nullptr) continue;
        if (last == nullptr || script->version_before()->replaced_by > last->version_before()->replaced_by)
            last = script;
    }
    return last;
}

}  // namespace

Expected<WordEnd> word_reload(Session::Parts& parts, const WordArguments&) {
    const auto report = parts.live.reloader().reload_all();
    if (!report) return Unexpected(report.error());
    parts.live.watch_again();
    const std::string text = report_text(parts.live.system(), *report);
    parts.show(text.empty() ? "no script has changed" : text);
    return WordEnd::done;
}

Expected<WordEnd> word_rollback(Session::Parts& parts, const WordArguments& arguments) {
    ScriptComponent* script = nullptr;
    if (arguments.has(1)) {
        const auto at = parts.objects->to_component(arguments.lua, 1);
        if (!at) return Unexpected(at.error());
        script = dynamic_cast<ScriptComponent*>(at->component);
        if (script == nullptr) return failure(fmt::format("{} is no script", at->component->name()));
    } else {
        script = changed_last(parts.live.system());
        if (script == nullptr) return failure("there is no version to go back to");
    }
    const auto report = parts.live.reloader().rollback(*script);
    if (!report) return Unexpected(report.error());
    parts.live.watch_again();
    parts.show(report_text(parts.live.system(), *report));
    return WordEnd::done;
}

Expected<WordEnd> word_save(Session::Parts& parts, const WordArguments& arguments) {
    const auto file = arguments.text(1, "the name of a file, as in save \"system.lua\"");
    if (!file) return Unexpected(file.error());
    const auto done = save_system(parts.live, *file);
    if (!done) return Unexpected(done.error());
    parts.show(*done);
    return WordEnd::done;
}

}  // namespace nezumi
