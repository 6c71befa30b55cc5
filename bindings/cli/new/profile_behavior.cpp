// Names and types that a behaviour can't have become comments; a safe value is JSON in a profile.
#include "bindings/cli/new/profile_behavior.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "bindings/journal/value_json.hpp"
#include "bindings/openrtm/rtm_wiring.hpp"
#include "engine/base/list.hpp"
#include "engine/base/lua_text.hpp"
#include "engine/base/names.hpp"
#include "engine/base/visible.hpp"
#include "engine/components/parameter_fields.hpp"
#include "engine/ports/payload.hpp"
#include "engine/records/write_record.hpp"
#include "engine/tree/member.hpp"
#include "engine/values/value_text.hpp"

namespace nezumi::cli {
namespace {

using openrtm::ComponentProfile;
using openrtm::ProfilePort;
using Json = nlohmann::ordered_json;

constexpr double usual_rate = 100;  // [Hz] of a system's tick
constexpr std::size_t longest_name = 80;

// Letters, digits and underscores, not beginning with a digit.
std::string word_of(std::string_view given) {
    std::string word(given.substr(0, longest_name));
    std::replace_if(
        word.begin(), word.end(), [](char c) { return !is_identifier(std::string("_") + c); }, '_');
    if (word.empty() || !is_identifier("_" + word.substr(0, 1)) || (word[0] >= '0' && word[0] <= '9'))
        word = "_" + word;
    return word;
}

// A name that a port or a parameter may have, and that is not in `taken`.
std::string new_name(std::string_view given, bool may_be_keyword, std::vector<std::string>& taken) {
    std::string name = word_of(given);
    const auto& members = names_taken_by_components();
    const bool is_keyword_alone = is_keyword(name);
    if ((is_keyword_alone && !may_be_keyword) || (!is_keyword_alone && is_taken_word(name)) ||
        contains(members, name)) {
        name = "my_" + name;
    }
    const std::string first = name;
    for (int i = 2; contains(taken, name); ++i) name = fmt::format("{}_{}", first, i);
    taken.push_back(name);
    return name;
}

class PartsWriter {
public:
    PartsWriter(const ComponentProfile& profile, const MessageFinder& messages, std::vector<std::string>& remarks)
        : profile_(profile), messages_(messages), remarks_(remarks) {}

    BehaviorParts write() {
        write_name();
        parts_.doc = profile_.doc;
        parts_.about = {profile_.version, profile_.vendor, profile_.category, true};
        parts_.rate = profile_.rate;
        for (const std::string& callback : profile_.callbacks) {
            if (callback != "on_execute") parts_.callbacks.push_back(callback);
        }
        for (const ProfilePort& port : profile_.ports) write_port(port);
        for (const ParameterSpec& spec : profile_.parameters) write_parameter(spec);
        remarks_.insert(remarks_.end(), profile_.remarks.begin(), profile_.remarks.end());
        for (std::string& each : remarks_) {
            std::replace(each.begin(), each.end(), '\n', ' ');
            each = visible(each);
        }
        parts_.comments.push_back(fmt::format("From RTCBuilder's profile of {}.{}", shown(profile_.name),
                                              remarks_.empty() ? "" : " It also says:"));
        for (const std::string& each : remarks_) parts_.comments.push_back("  " + each);
        return std::move(parts_);
    }

private:
    void write_name() {
        auto name = new_file_name("behaviour", profile_.name);
        if (!name) name = new_file_name("behaviour", word_of(profile_.name));
        if (!name) name = new_file_name("behaviour", word_of(profile_.name) + "_rtc");
        parts_.name = *name;
        if (const std::string type = type_of_file(*name + ".lua"); type != profile_.name)
            remarks_.push_back(fmt::format("component '{}' is the type '{}' here", shown(profile_.name), type));
    }

    void write_port(const ProfilePort& port) {
        const bool is_in = port.direction == Direction::in;
        const std::string file = "behaviors/" + parts_.name + ".lua";
        auto found = messages_(port.type, file, nullptr);
        // If other packages have a type of this name too, the type of OpenRTM (package RTC) is meant.
        if (!found && port.type.find('/') == std::string::npos) {
            if (auto of_rtc = messages_("RTC/" + port.type, file, nullptr)) found = of_rtc;
        }
        if (!found) {
            const bool is_unknown = found.error().message.starts_with("unknown type");
            remarks_.push_back(fmt::format("port '{}': {}", shown(port.name),
                                           is_unknown ? unknown_type(port) : with_file_name(found.error())));
            parts_.declarations.push_back(fmt::format("{}({}, {}, {})", is_in ? "input" : "output",
                                                      lua_quoted(port.name), lua_quoted(port.type),
                                                      lua_quoted(port.doc)));
            return;
        }
        NewPort written{.name = new_name(port.name, true, taken_ports_), .type = found->type, .doc = port.doc};
        if (written.name != port.name) {
            remarks_.push_back(
                fmt::format("port '{0}' is named '{1}' here; to keep its name for other RTCs, write rtm {{ rename = {{ "
                            "[\"{2}.{1}\"] = {3} }} }}",
                            shown(port.name), written.name, parts_.name, lua_quoted(shown(port.name))));
        }
        if (is_in && port.queue > 0)
            written.options = fmt::format("queue = {}", std::min<std::size_t>(port.queue, 100'000));
        if (!is_in && !port.safe.empty()) written.options = safe_text(port, found->type);
        (is_in ? parts_.inputs : parts_.outputs).push_back(std::move(written));
    }

    static std::string unknown_type(const ProfilePort& port) {
        const std::string where =
            port.idl_file.empty()
                ? ""
                : fmt::format(" of {} (put this file into behaviors/messages/ and try again)", port.idl_file);
        return fmt::format("there is no message type '{}'{}", shown(port.type), where);
    }

    // The error in the definition of a message type. It shows the file name alone, because the folder may exist only on
    // this computer.
    static std::string with_file_name(Error error) {
        error.place.file = error.place.file.substr(error.place.file.rfind('/') + 1);
        return describe(error);
    }

    std::string safe_text(const ProfilePort& port, const MessageType* type) {
        const Json json = Json::parse(port.safe, nullptr, false);
        Value value = make_payload(type);
        if (const std::string wrong = json.is_discarded() ? "it is not JSON" : read_value(json, value);
            !wrong.empty()) {
            remarks_.push_back(fmt::format("port '{}': its safe value: {}", shown(port.name), wrong));
            return "";
        }
        return "safe = " + lua_text(value);
    }

    void write_parameter(const ParameterSpec& spec) {
        const NewParameter written{.name = new_name(spec.name, false, taken_parameters_),
                                   .initial = lua_text(spec.initial),
                                   .options = options_of(spec)};
        if (written.name != spec.name)
            remarks_.push_back(fmt::format("parameter '{}' is named '{}' here", shown(spec.name), written.name));
        parts_.parameters.push_back(written);
    }

    static std::string options_of(const ParameterSpec& spec) {
        std::string text;
        const auto add = [&](const char* name, const std::string& value) {
            text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", name, value);
        };
        // The bounds of an integer are written as integers.
        const auto number = [&](double value) {
            const bool is_whole =
                spec.initial.type().single().is_integer() && std::abs(value) < 1e15 && value == std::floor(value);
            return is_whole ? fmt::format("{:.0f}", value) : lua_number(value);
        };
        if (spec.min) add("min", number(*spec.min));
        if (spec.max) add("max", number(*spec.max));
        if (spec.step > 0) add("step", number(spec.step));
        ParameterSpec others = spec;
        others.min = others.max = std::nullopt;
        others.step = 0;
        if (const std::string record = write_record(others); record != "{}")
            text += (text.empty() ? "" : ", ") + record.substr(2, record.size() - 4);
        std::string choices;
        for (const Value& choice : spec.choices) choices += (choices.empty() ? "" : ", ") + lua_text(choice);
        if (!choices.empty()) add("choices", "{ " + choices + " }");
        return text;
    }

    const ComponentProfile& profile_;
    const MessageFinder& messages_;
    std::vector<std::string>& remarks_;
    std::vector<std::string> taken_ports_, taken_parameters_;
    BehaviorParts parts_;
};

}  // namespace

BehaviorParts parts_of(const ComponentProfile& profile, const MessageFinder& messages,
                       std::vector<std::string>& remarks) {
    return PartsWriter(profile, messages, remarks).write();
}

ComponentProfile profile_of(Script& script) {
    ComponentProfile profile{.name = type_of_file(script.file().path),
                             .doc = script.doc(),
                             .version = script.about().version,
                             .vendor = script.about().vendor,
                             .category = script.about().category,
                             .rate = usual_rate};
    for (const std::string_view name : hook_names()) {
        if (script.hook_function(name) == LUA_REFNIL) continue;
        if (name == to_text(Hook::on_reload)) {
            profile.remarks.emplace_back("callback on_reload");
        } else {
            profile.callbacks.emplace_back(name);
        }
    }
    for (const PortDeclaration& port : script.ports()) {
        const std::string& type = port.type->name;
        if (openrtm::rtm_type_id(*port.type).empty())
            profile.remarks.push_back(fmt::format("port '{}': OpenRTM has no type {}", port.name, type));
        profile.ports.push_back({.direction = port.direction,
                                 .name = port.name,
                                 .type = type,
                                 .doc = port.doc,
                                 .queue = port.queue,
                                 .safe = port.safe.empty() ? "" : value_to_json(port.safe.front()).dump()});
    }
    // In-ports first, as `behavior_text` writes them.
    std::stable_partition(profile.ports.begin(), profile.ports.end(),
                          [](const ProfilePort& port) { return port.direction == Direction::in; });
    for (const auto& parameter : script.parameters().all()) profile.parameters.push_back(parameter.spec);
    for (const CommandDeclaration& command : script.commands())
        profile.remarks.push_back(fmt::format("command '{}'", command.name));
    for (const Task& task : script.tasks().all()) profile.remarks.push_back(fmt::format("task '{}'", task.name));
    return profile;
}

}  // namespace nezumi::cli
