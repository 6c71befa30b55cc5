// Commands for versions of scripts.
#include <fmt/format.h>

#include <optional>

#include "bindings/console/console_commands.hpp"

namespace nezumi {
namespace {

std::string report_text(const System& system, const ActResult& report) {
    std::string text;
    for (const std::string& name : report.components) {
        const Component* component = system.find(name);
        if (component == nullptr) continue;
        text += fmt::format("{}{}: version {} runs", text.empty() ? "" : "\n", name, component->version());
    }
    for (const std::string& note : report.notes) text += "\n" + note;
    return text;
}

// The component whose version changed last.
const Component* changed_last(const System& system) {
    const Component* last = nullptr;
    for (const Component* component : system.components()) {
        if (component->last_reload() > (last != nullptr ? last->last_reload() : 0)) last = component;
    }
    return last;
}

}  // namespace

Expected<CommandEnd> command_reload(Session::Parts& parts, const Arguments&) {
    const auto report = parts.act_beside(Reload{});
    if (!report) return Unexpected(report.error());
    const auto text = parts.at_system([&] { return std::make_optional(report_text(parts.live.system(), *report)); });
    if (!text) return failure("interrupted");
    parts.show(report->components.empty() ? "no script has changed" : *text);
    return CommandEnd::done;
}

Expected<CommandEnd> command_rollback(Session::Parts& parts, const Arguments& arguments) {
    const Component* component = nullptr;
    if (arguments.has(1)) {
        const auto at = parts.objects->to_component(arguments.lua, 1);
        if (!at) return Unexpected(at.error());
        component = at->component;
    } else {
        component = changed_last(parts.live.system());
        if (component == nullptr) return failure("there is no version to go back to");
    }
    const auto report = parts.act(Rollback{component->name()});
    if (!report) return Unexpected(report.error());
    parts.show(report_text(parts.live.system(), *report));
    return CommandEnd::done;
}

}  // namespace nezumi
