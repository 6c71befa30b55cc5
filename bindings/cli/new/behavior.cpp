// Reads the arguments of the command line, and checks that the result loads.
#include "bindings/cli/new/behavior.hpp"

#include <fmt/format.h>

#include <string_view>
#include <utility>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/new/files.hpp"
#include "bindings/console/session.hpp"
#include "bindings/lua/script/behavior_maker.hpp"
#include "bindings/lua/script/check_script.hpp"
#include "engine/base/list.hpp"

namespace nezumi::cli {
namespace {

// Adds the ports of an option to `ports`. `find` finds the types as seen from the file behaviors/BEHAVIOR.lua.
Expected<void> read_ports(std::string_view option, const std::vector<std::string>& given,
                          std::vector<std::string>& taken, std::vector<NewPort>& ports, const MessageFinder& find,
                          const std::string& behavior) {
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
        const auto found = find(type, "behaviors/" + behavior + ".lua", nullptr);
        if (!found) return failure(fmt::format("{} '{}': {}", option, port.name, found.error().message));
        port.type = found->type;
        port.doc = second == std::string::npos ? port.type->doc : text.substr(second + 1);
        ports.push_back(std::move(port));
    }
    return {};
}

Expected<void> read_callbacks(const std::vector<std::string>& given, std::vector<std::string>& callbacks) {
    for (const std::string& name : given) {
        const auto& known = hook_names();
        if (!contains(known, name)) {
            return failure(fmt::format("--callback '{}': there is no such callback{}; known are {}", shown(name),
                                       did_you_mean(name, known), fmt::join(known, ", ")));
        }
        if (auto ok = take_new_name("--callback", name, callbacks); !ok) return ok;
    }
    return {};
}

// A value of the command line replaces the earlier one.
void take_over(std::string& text, const std::string& given) {
    if (!given.empty()) text = given;
}

}  // namespace

MessageFinder new_messages() { return messages_of(Project::of("here", installed_folders())); }

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
    const MessageFinder find = new_messages();
    if (auto ok = read_ports("--in", wanted.inputs, taken, parts.inputs, find, parts.name); !ok)
        return Unexpected(ok.error());
    if (auto ok = read_ports("--out", wanted.outputs, taken, parts.outputs, find, parts.name); !ok)
        return Unexpected(ok.error());
    for (const std::string& text : wanted.parameters) {
        auto parameter = read_new_parameter(text);
        if (!parameter) return Unexpected(parameter.error());
        if (auto ok = take_new_name("--param", parameter->name, taken_parameters); !ok) return Unexpected(ok.error());
        parts.parameters.push_back(std::move(*parameter));
    }
    if (auto ok = read_callbacks(wanted.callbacks, parts.callbacks); !ok) return Unexpected(ok.error());
    BehaviorTexts texts{parts.name, behavior_text(parts), behavior_scenario_text(parts)};
    // The check of scripts finds the remaining errors, such as a name that has another meaning in scripts.
    const std::string file = parts.name + ".lua";
    const auto errors = check_behavior({file, file, texts.behavior}, {.component = parts.name, .find_message = find});
    if (!errors.empty()) return failure(errors.front().message);
    return texts;
}

Expected<std::vector<std::string>> write_new_behavior(const std::filesystem::path& root,
                                                      const BehaviorRequest& request) {
    const auto texts = write_behavior({.name = request.name,
                                       .inputs = request.inputs,
                                       .outputs = request.outputs,
                                       .parameters = request.parameters,
                                       .callbacks = request.callbacks,
                                       .doc = request.doc});
    if (!texts) return Unexpected(texts.error());
    std::error_code none;
    const bool has_scenarios = std::filesystem::is_directory(root / "tests/scenarios", none);
    const std::filesystem::path behavior = std::filesystem::path("behaviors") / (texts->name + ".lua");
    const std::filesystem::path scenario =
        std::filesystem::path(has_scenarios ? "tests/scenarios" : "tests") / (texts->name + "_test.lua");
    const auto written = write_new_files({{root / behavior, texts->behavior}, {root / scenario, texts->scenario}});
    if (!written) return Unexpected(written.error());
    return std::vector<std::string>{behavior.string(), scenario.string()};
}

}  // namespace nezumi::cli
