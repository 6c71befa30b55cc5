// Fills the template of a behaviour, and checks that the result loads.
#include "bindings/cli/new/behavior.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include "bindings/lua/files/system_words.hpp"
#include "bindings/lua/sandbox/stdlib.hpp"
#include "bindings/lua/script/check_script.hpp"
#include "bindings/lua/script/script_globals.hpp"
#include "engine/base/lua_text.hpp"
#include "engine/base/names.hpp"
#include "engine/ports/payload.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi::cli {
namespace {

struct NewPort {
    std::string name;
    std::size_t type = 0;  // of its messages
    std::string local;     // the variable that holds it
    std::string doc;
};

// Names used in the file that a local variable must not hide.
bool is_taken_word(const std::string& name) {
    const auto has = [&](const auto& names) { return std::find(names.begin(), names.end(), name) != names.end(); };
    return is_keyword(name) || has(script_globals()) || has(sandbox_names());
}

Expected<std::vector<NewPort>> read_ports(std::string_view option, const std::vector<std::string>& given,
                                          std::vector<std::string>& taken) {
    std::vector<NewPort> ports;
    for (const std::string& text : given) {
        const std::size_t colon = text.find(':');
        if (colon == std::string::npos) {
            return failure(fmt::format("{0} '{1}': expected name:Type, for example {0} distance:TimedShortSeq", option,
                                       shown(text)));
        }
        NewPort port{text.substr(0, colon), 0, text.substr(0, colon), ""};
        const std::size_t second = text.find(':', colon + 1);
        const std::string type = text.substr(colon + 1, second == std::string::npos ? second : second - colon - 1);
        if (auto ok = take_new_name(option, port.name, taken); !ok) return Unexpected(ok.error());
        const auto found = std::find(message_type_names.begin(), message_type_names.end(), type);
        if (found == message_type_names.end()) {
            return failure(fmt::format("{} '{}': unknown type '{}'{}; `nezumi types` lists them all", option, port.name,
                                       shown(type),
                                       did_you_mean(type, {message_type_names.begin(), message_type_names.end()})));
        }
        port.type = static_cast<std::size_t>(found - message_type_names.begin());
        port.doc = second == std::string::npos ? std::string(message_infos()[port.type].doc) : text.substr(second + 1);
        if (is_taken_word(port.name)) port.local += "_port";
        ports.push_back(std::move(port));
    }
    return ports;
}

// A value of the type in Lua's form, used by a new behaviour and by its scenario.
std::string sample(const Type& type) {
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

// `world.ports["in"]` if `world.in` is not valid Lua.
std::string member(const std::string& name) {
    return is_keyword(name) ? fmt::format(".ports[\"{}\"]", name) : "." + name;
}

void add_declarations(std::string& text, std::string_view word, const std::vector<NewPort>& ports, std::size_t width) {
    for (const NewPort& port : ports) {
        text += fmt::format("local {:{}} = {}(\"{}\", \"{}\", {})\n", port.local, width, word, port.name,
                            message_type_names[port.type], lua_quoted(port.doc));
    }
}

Expected<std::vector<std::string>> read_callbacks(const std::vector<std::string>& given) {
    std::vector<std::string> callbacks;
    for (const std::string& name : given) {
        const auto& known = hook_names();
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            return failure(fmt::format("--callback '{}': there is no such callback{}; known are {}", shown(name),
                                       did_you_mean(name, known), fmt::join(known, ", ")));
        }
        if (auto ok = take_new_name("--callback", name, callbacks); !ok) return Unexpected(ok.error());
    }
    return callbacks;
}

// A comment for its empty body: when it is called.
std::string_view occasion_of(std::string_view callback) {
    constexpr std::pair<Hook, std::string_view> occasions[] = {
        {Hook::on_activated, "Before its first execution."},
        {Hook::on_deactivated, "When it is deactivated or removed, or the run ends."},
        {Hook::on_aborting, "Once, when an error has stopped it. No velocities are written here."},
        {Hook::on_error, "In every tick while it is in ERROR. No velocities are written here."},
        {Hook::on_reset, "When somebody resets it after an error."},
        {Hook::on_reload, "When a new version of this file takes over from version old_version."},
    };
    const auto found = std::find_if(std::begin(occasions), std::end(occasions),
                                    [&](const auto& each) { return to_text(each.first) == callback; });
    return found == std::end(occasions) ? "" : found->second;
}

std::string execution_text(const std::vector<NewPort>& inputs, const std::vector<NewPort>& outputs) {
    std::string text = "function on_execute()\n";
    for (const NewPort& port : inputs) {
        text += fmt::format("  local {}_now = {}:read()\n", port.name, port.local);
    }
    if (outputs.empty() && inputs.empty()) text += "  -- What it does, 100 times a second.\n";
    for (const NewPort& port : outputs) {
        const std::string value = sample(*message_infos()[port.type].payload);
        text += value.starts_with('{') ? fmt::format("  {}:write {}\n", port.local, value)
                                       : fmt::format("  {}:write({})\n", port.local, value);
    }
    return text + "end\n";
}

// In the order of calling.
std::string callbacks_text(const std::vector<NewPort>& inputs, const std::vector<NewPort>& outputs,
                           const std::vector<std::string>& wanted) {
    std::string text;
    for (const std::string_view callback : hook_names()) {
        const bool executes = callback == to_text(Hook::on_execute);
        if (!executes && std::find(wanted.begin(), wanted.end(), callback) == wanted.end()) continue;
        if (!text.empty()) text += "\n";
        text += executes
                    ? execution_text(inputs, outputs)
                    : fmt::format("function {}({})\n  -- {}\nend\n", callback,
                                  callback == to_text(Hook::on_reload) ? "old_version" : "", occasion_of(callback));
    }
    return text;
}

std::string behavior_text(const std::string& name, const std::string& doc, const std::vector<NewPort>& inputs,
                          const std::vector<NewPort>& outputs, const std::vector<NewParameter>& parameters,
                          const std::vector<std::string>& callbacks) {
    std::string text = doc.empty()
                           ? fmt::format("--- {}: say in a sentence what it does.\n\n", type_of_file(name + ".lua"))
                           : fmt::format("--- {}\n\n", doc);
    std::size_t width = 0;
    for (const auto* ports : {&inputs, &outputs}) {
        for (const NewPort& port : *ports) width = std::max(width, port.local.size());
    }
    add_declarations(text, "input", inputs, width);
    add_declarations(text, "output", outputs, width);
    if (!inputs.empty() || !outputs.empty()) text += "\n";
    for (const NewParameter& parameter : parameters) {
        text += fmt::format("param(\"{}\", {}, {{ {} }})\n", parameter.name, parameter.initial, parameter.options);
    }
    if (!parameters.empty()) text += "\n";
    return text + callbacks_text(inputs, outputs, callbacks);
}

std::string behavior_scenario_text(const std::string& name, const std::vector<NewPort>& inputs,
                                   const std::vector<NewPort>& outputs) {
    // A component must not have the name of a console command, nor hide a variable of the scenario.
    const std::string component = is_taken_name(name) ? name + "_1" : name;
    const bool hides = is_taken_word(name) || name == "s" || name == "scenario" || name == "range";
    const std::string variable = hides ? "it" : component;
    std::string text = fmt::format(
        "scenario(\"{0} runs\", {{ timeout = 10 }}, function(s)\n"
        "  s:behavior \"{2}\" {{ script = \"{0}\" }}\n"
        "  local {1} = s.world.{2}\n\n"
        "  s:always(\"is well\", function() return {1}.status == \"ACTIVE\" end)\n",
        name, variable, component);
    for (const NewPort& port : inputs) {
        text += fmt::format("  s:inject(\"{}.{}\", {})\n", component, port.name,
                            sample(*message_infos()[port.type].payload));
    }
    text += "  s:run(1)\n";
    for (const NewPort& port : outputs) {
        text += fmt::format("  s:check({}{}.tm > 0, \"{} was written\")\n", variable, member(port.name), port.name);
    }
    return text + "end)\n";
}

}  // namespace

Expected<BehaviorTexts> write_behavior(const NewBehavior& wanted) {
    auto name = new_file_name("behaviour", wanted.name);
    if (!name) return Unexpected(name.error());
    if (wanted.doc.find('\n') != std::string::npos) return failure("--doc: expected one line");
    std::vector<std::string> taken;
    auto inputs = read_ports("--in", wanted.inputs, taken);
    if (!inputs) return Unexpected(inputs.error());
    auto outputs = read_ports("--out", wanted.outputs, taken);
    if (!outputs) return Unexpected(outputs.error());
    std::vector<NewParameter> parameters;
    std::vector<std::string> taken_parameters;
    for (const std::string& text : wanted.parameters) {
        auto parameter = read_new_parameter(text);
        if (!parameter) return Unexpected(parameter.error());
        if (auto ok = take_new_name("--param", parameter->name, taken_parameters); !ok) return Unexpected(ok.error());
        parameters.push_back(std::move(*parameter));
    }
    const auto callbacks = read_callbacks(wanted.callbacks);
    if (!callbacks) return Unexpected(callbacks.error());
    BehaviorTexts texts{*name, behavior_text(*name, wanted.doc, *inputs, *outputs, parameters, *callbacks),
                        behavior_scenario_text(*name, *inputs, *outputs)};
    // The remaining errors are words with another meaning; the script's own check finds them.
    const auto errors = check_behavior({*name + ".lua", *name + ".lua", texts.behavior}, {.component = *name});
    if (!errors.empty()) return failure(errors.front().message);
    return texts;
}

}  // namespace nezumi::cli
