// Reads the command line's words, and checks that the result loads.
#include "bindings/cli/new/behavior.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "bindings/lua/script/check_script.hpp"
#include "engine/ports/payload.hpp"

namespace nezumi::cli {
namespace {

// Adds them to `ports`.
Expected<void> read_ports(std::string_view option, const std::vector<std::string>& given,
                          std::vector<std::string>& taken, std::vector<NewPort>& ports) {
    for (const std::string& text : given) {
        const std::size_t colon = text.find(':');
        if (colon == std::string::npos) {
            return failure(fmt::format("{0} '{1}': expected name:Type, for example {0} distance:TimedShortSeq", option,
                                       shown(text)));
        }
        NewPort port{.name = text.substr(0, colon)};
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
        ports.push_back(std::move(port));
    }
    return {};
}

Expected<void> read_callbacks(const std::vector<std::string>& given, std::vector<std::string>& callbacks) {
    for (const std::string& name : given) {
        const auto& known = hook_names();
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            return failure(fmt::format("--callback '{}': there is no such callback{}; known are {}", shown(name),
                                       did_you_mean(name, known), fmt::join(known, ", ")));
        }
        if (auto ok = take_new_name("--callback", name, callbacks); !ok) return ok;
    }
    return {};
}

// What the command line says takes the place of what was there.
void take_over(std::string& text, const std::string& given) {
    if (!given.empty()) text = given;
}

}  // namespace

Expected<BehaviorTexts> write_behavior(const NewBehavior& wanted) {
    BehaviorParts parts = wanted.base;
    if (!wanted.name.empty() || parts.name.empty()) {
        auto name = new_file_name("behaviour", wanted.name);
        if (!name) return Unexpected(name.error());
        parts.name = *name;
    }
    if (wanted.doc.find('\n') != std::string::npos) return failure("--doc: expected one line");
    take_over(parts.doc, wanted.doc);
    take_over(parts.about.version, wanted.about.version);
    take_over(parts.about.vendor, wanted.about.vendor);
    take_over(parts.about.category, wanted.about.category);
    std::vector<std::string> taken, taken_parameters;
    for (const auto* ports : {&parts.inputs, &parts.outputs}) {
        for (const NewPort& port : *ports) taken.push_back(port.name);
    }
    for (const NewParameter& parameter : parts.parameters) taken_parameters.push_back(parameter.name);
    if (auto ok = read_ports("--in", wanted.inputs, taken, parts.inputs); !ok) return Unexpected(ok.error());
    if (auto ok = read_ports("--out", wanted.outputs, taken, parts.outputs); !ok) return Unexpected(ok.error());
    for (const std::string& text : wanted.parameters) {
        auto parameter = read_new_parameter(text);
        if (!parameter) return Unexpected(parameter.error());
        if (auto ok = take_new_name("--param", parameter->name, taken_parameters); !ok) return Unexpected(ok.error());
        parts.parameters.push_back(std::move(*parameter));
    }
    if (auto ok = read_callbacks(wanted.callbacks, parts.callbacks); !ok) return Unexpected(ok.error());
    BehaviorTexts texts{parts.name, behavior_text(parts), behavior_scenario_text(parts)};
    // The remaining errors are words with another meaning; the script's own check finds them.
    const std::string file = parts.name + ".lua";
    const auto errors = check_behavior({file, file, texts.behavior}, {.component = parts.name});
    if (!errors.empty()) return failure(errors.front().message);
    return texts;
}

}  // namespace nezumi::cli
