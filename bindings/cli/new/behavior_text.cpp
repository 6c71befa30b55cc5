// Fills the templates of a behaviour and of its scenario.
#include "bindings/cli/new/behavior_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "bindings/lua/files/system_words.hpp"
#include "bindings/lua/sandbox/stdlib.hpp"
#include "bindings/lua/script/script_globals.hpp"
#include "engine/base/list.hpp"
#include "engine/base/lua_text.hpp"
#include "engine/base/names.hpp"
#include "engine/base/visible.hpp"
#include "engine/system/system_spec.hpp"
#include "engine/values/value_text.hpp"

namespace nezumi::cli {
namespace {

constexpr double usual_tick_rate = 100;  // [Hz] of the scenario's system

// The variable that holds a port.
std::string local_of(const NewPort& port) { return is_taken_word(port.name) ? port.name + "_port" : port.name; }

// A value of the type in Lua's form, used by a new behaviour and by its scenario.
std::string sample(const Type& type) {
    if (type.kind == Type::Kind::array || type.kind == Type::Kind::enumeration) return lua_text(Value(type));
    if (type.kind == Type::Kind::sequence) {
        const std::string element = type.element->is_floating() ? "0.0" : sample(*type.element);
        return "{ " + element + ", " + element + " }";
    }
    if (type.is_number()) return "0";
    if (type.kind == Type::Kind::boolean) return "false";
    if (type.kind != Type::Kind::structure) return "\"\"";
    std::string text;
    for (const Type::Field& field : type.fields)
        text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", field.name, sample(*field.type));
    return text.size() > 80 ? "{}" : "{ " + text + " }";  // omitted fields are zero
}

// The access to a port: `.out`, or `.ports["in"]` if the name is a keyword of Lua.
std::string member(const std::string& name) {
    return is_keyword(name) ? fmt::format(".ports[\"{}\"]", name) : "." + name;
}

void add_declarations(std::string& text, std::string_view word, const std::vector<NewPort>& ports, std::size_t width) {
    for (const NewPort& port : ports) {
        text += fmt::format("local {:{}} = {}(\"{}\", \"{}\", {}{})\n", local_of(port), width, word, port.name,
                            port.type->name, lua_quoted(port.doc),
                            port.options.empty() ? "" : ", { " + port.options + " }");
    }
}

std::string about_text(const ScriptAbout& about) {
    std::string text;
    for (const auto& [name, value] :
         {std::pair{"version", about.version}, {"vendor", about.vendor}, {"category", about.category}}) {
        if (!value.empty()) text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", name, lua_quoted(value));
    }
    return text.empty() ? "" : "about { " + text + " }\n\n";
}

// The comment in the empty body of a callback: when the callback is called.
std::string_view occasion_of(std::string_view callback) {
    constexpr std::pair<Hook, std::string_view> occasions[] = {
        {Hook::on_activated, "Before its first execution."},
        {Hook::on_deactivated, "When it is deactivated or removed, or the run ends."},
        {Hook::on_aborting, "Once, when an error has stopped it. No velocities are written here."},
        {Hook::on_error, "In every tick while it is in ERROR. No velocities are written here."},
        {Hook::on_reset, "When it is reset after an error."},
        {Hook::on_reload, "When a new version of this file takes over from version old_version."},
    };
    const auto found = std::find_if(std::begin(occasions), std::end(occasions),
                                    [&](const auto& each) { return to_text(each.first) == callback; });
    return found == std::end(occasions) ? "" : found->second;
}

std::string execution_text(const std::vector<NewPort>& inputs, const std::vector<NewPort>& outputs) {
    std::string text = "function on_execute()\n";
    for (const NewPort& port : inputs) {
        text += fmt::format("  local {}_now = {}:read()\n", port.name, local_of(port));
    }
    if (outputs.empty() && inputs.empty()) text += "  -- What it does, 100 times a second.\n";
    for (const NewPort& port : outputs) {
        const std::string value = sample(*port.type->payload);
        text += value.starts_with('{') ? fmt::format("  {}:write {}\n", local_of(port), value)
                                       : fmt::format("  {}:write({})\n", local_of(port), value);
    }
    return text + "end\n";
}

// In the order of calling.
std::string callbacks_text(const BehaviorParts& parts) {
    std::string text;
    for (const std::string_view callback : hook_names()) {
        const bool executes = callback == to_text(Hook::on_execute);
        if (!executes && !contains(parts.callbacks, callback)) continue;
        if (!text.empty()) text += "\n";
        text += executes
                    ? execution_text(parts.inputs, parts.outputs)
                    : fmt::format("function {}({})\n  -- {}\nend\n", callback,
                                  callback == to_text(Hook::on_reload) ? "old_version" : "", occasion_of(callback));
    }
    return text;
}

}  // namespace

std::string comment_text(std::string_view dashes, std::string_view lines) {
    std::string text;
    while (true) {
        const std::size_t end = std::min(lines.find('\n'), lines.size());
        text += fmt::format("{}{}{}\n", dashes, end > 0 ? " " : "", visible(lines.substr(0, end)));
        if (end == lines.size()) return text;
        lines.remove_prefix(end + 1);
    }
}

bool is_taken_word(const std::string& name) {
    return is_keyword(name) || contains(script_globals(), name) || contains(sandbox_names(), name);
}

std::string behavior_text(const BehaviorParts& parts) {
    const std::string placeholder = type_of_file(parts.name + ".lua") + ": say in a sentence what it does.";
    std::string text =
        comment_text("---", parts.doc.empty() ? placeholder : parts.doc) + "\n" + about_text(parts.about);
    for (const std::string& line : parts.comments) text += comment_text("--", line);
    if (!parts.comments.empty()) text += "\n";
    std::size_t width = 0;
    for (const auto* ports : {&parts.inputs, &parts.outputs}) {
        for (const NewPort& port : *ports) width = std::max(width, local_of(port).size());
    }
    add_declarations(text, "input", parts.inputs, width);
    add_declarations(text, "output", parts.outputs, width);
    if (width > 0) text += "\n";
    for (const NewParameter& parameter : parts.parameters) {
        text += fmt::format("param(\"{}\", {}{})\n", parameter.name, parameter.initial,
                            parameter.options.empty() ? "" : ", { " + parameter.options + " }");
    }
    if (!parts.parameters.empty()) text += "\n";
    for (const std::string& line : parts.declarations) text += comment_text("--", line);
    if (!parts.declarations.empty()) text += "\n";
    return text + callbacks_text(parts);
}

std::string behavior_scenario_text(const BehaviorParts& parts) {
    const std::string& name = parts.name;
    // A component must not have the name of a console command, nor hide a variable of the scenario.
    const std::string component = is_taken_name(name) ? name + "_1" : name;
    const bool hides = is_taken_word(name) || name == "s" || name == "scenario" || name == "range";
    const std::string variable = hides ? "it" : component;
    const bool is_slow = parts.rate > 0 && parts.rate < usual_tick_rate;
    const double seconds = is_slow ? std::max(1.0, std::ceil(2 / parts.rate)) : 1;
    std::string text = fmt::format(
        "scenario(\"{0} runs\", {{ timeout = {3} }}, function(s)\n"
        "  s:behavior \"{2}\" {{ script = \"{0}\"{4} }}\n"
        "  local {1} = s.world.{2}\n\n"
        "  s:always(\"is well\", function() return {1}.status == \"ACTIVE\" end)\n",
        name, variable, component, seconds + 9, is_slow ? fmt::format(", rate = {}", parts.rate) : "");
    for (const NewPort& port : parts.inputs) {
        text += fmt::format("  s:inject(\"{}.{}\", {})\n", component, port.name, sample(*port.type->payload));
    }
    text += fmt::format("  s:run({})\n", seconds);
    for (const NewPort& port : parts.outputs) {
        text += fmt::format("  s:check({}{}.tm > 0, \"{} was written\")\n", variable, member(port.name), port.name);
    }
    return text + "end)\n";
}

}  // namespace nezumi::cli
