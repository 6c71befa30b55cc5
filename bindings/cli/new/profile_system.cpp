// Makes system files from RTSystemEditor's profiles. Each behaviour is loaded to learn its parameters and ports, so
// that the system file is valid.
#include "bindings/cli/new/profile_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "bindings/cli/new/arguments.hpp"
#include "bindings/cli/new/behavior_text.hpp"
#include "bindings/openrtm/restore_system.hpp"
#include "bindings/openrtm/rtc_profiles.hpp"
#include "bindings/openrtm/rtm_spec.hpp"
#include "engine/base/list.hpp"
#include "engine/base/lua_text.hpp"
#include "engine/base/names.hpp"
#include "engine/base/visible.hpp"
#include "engine/values/value_text.hpp"

namespace nezumi::cli {
namespace {

using openrtm::ProfiledComponent;
using openrtm::ProfiledEnd;
using openrtm::SystemProfile;

constexpr double full_rate = 100;  // [Hz] of a system's tick
constexpr std::string_view default_set = "default";

class SystemWriter {
public:
    SystemWriter(const SystemProfile& profile, const BehaviorFinder& find, std::vector<std::string>& remarks)
        : profile_(profile), find_(find), remarks_(remarks) {}

    std::string write() {
        for (const ProfiledComponent& component : profile_.components) write_component(component);
        for (const auto& connection : profile_.connections) write_connection(connection.from, connection.to);
        for (const auto& connection : profile_.service_connections)
            remarks_.push_back(fmt::format("connection of service ports '{}'", shown(connection.name)));
        remarks_.insert(remarks_.end(), profile_.remarks.begin(), profile_.remarks.end());
        const std::string doc = profile_.doc.empty() ? "RTSystemEditor's system " + profile_.name : profile_.doc;
        std::string text = comment_text("---", doc);
        for (std::string& remark : remarks_) {
            remark = visible(remark);
            text += comment_text("--", "not here: " + remark);
        }
        std::string exported;
        for (const std::string& name : exported_) exported += (exported.empty() ? "" : ", ") + lua_quoted(name);
        if (!exported.empty()) exported = fmt::format("\nrtm {{ {}export = {{ {} }} }}\n", nameserver_text(), exported);
        return text + "\n" + behaviors_ + exported + (connections_.empty() ? "" : "\n") + connections_;
    }

private:
    struct Known {
        std::string name;  // in the system file
        std::unique_ptr<Script> script;
    };

    // The name services of the profile's components, if they are not the usual one.
    std::string nameserver_text() {
        const auto servers = openrtm::nameservers_of(profile_);
        if (!servers) {
            remarks_.push_back(servers.error().message);
            return "";
        }
        if (*servers == openrtm::RtmSpec{}.nameservers) return "";
        std::string all;
        for (const std::string& server : *servers) all += (all.empty() ? "" : ", ") + lua_quoted(server);
        return fmt::format("nameserver = {{ {} }}, ", all);
    }

    void write_component(const ProfiledComponent& component) {
        const auto script = new_file_name("behaviour", component.type);
        auto loaded = script ? find_(*script) : nullptr;
        if (loaded == nullptr) return;  // it stays an RTC
        // An exported component "mouse" is the RTC "mouse0".
        std::string name = component.instance;
        if (name.size() > 1 && name.ends_with('0')) name.pop_back();
        if (!is_identifier(name) || is_reserved_name(name)) name = *script;
        if (is_reserved_name(name)) name = "my_" + name;
        const std::string first = name;
        for (int i = 2; contains(names_, name); ++i) name = fmt::format("{}_{}", first, i);
        names_.push_back(name);
        behaviors_ += fmt::format("behavior {} {{ script = {}", lua_quoted(name), lua_quoted(*script));
        write_sets(component, *loaded);
        if (component.rate > 0 && component.rate < full_rate) behaviors_ += fmt::format(", rate = {}", component.rate);
        behaviors_ += " }\n";
        known_.insert_or_assign(component.instance, Known{name, std::move(loaded)});
    }

    void write_sets(const ProfiledComponent& component, Script& script) {
        std::string sets;
        bool has_set = false;
        for (const auto& [set, values] : component.sets) {
            if (set.starts_with("__")) continue;  // widgets, constraints and types for tools
            const std::string text = values_text(component, values, script);
            if (set == default_set) {
                if (!text.empty()) behaviors_ += fmt::format(", config = {{ {} }}", text);
            } else if (!is_identifier(set)) {
                remarks_.push_back(fmt::format("component '{}': its set '{}'", shown(component.instance), shown(set)));
            } else {
                sets += fmt::format("{}{} = {{ {} }}", sets.empty() ? "" : ", ", set, text);
                has_set = has_set || set == component.set;
            }
        }
        if (!sets.empty()) behaviors_ += fmt::format(", sets = {{ {} }}", sets);
        if (has_set) behaviors_ += fmt::format(", set = {}", lua_quoted(component.set));
    }

    std::string values_text(const ProfiledComponent& component,
                            const std::vector<std::pair<std::string, std::string>>& values, Script& script) {
        std::string all;
        for (const auto& [name, text] : values) {
            const auto* parameter = script.parameters().find(name);
            const auto value =
                parameter != nullptr ? openrtm::from_rtc_text(text, parameter->spec.initial) : std::nullopt;
            if (!value || !check_value(parameter->spec, *value)) {
                remarks_.push_back(
                    fmt::format("component '{}': {} = '{}'", shown(component.instance), shown(name), shown(text)));
            } else if (*value != parameter->spec.initial) {
                all += fmt::format("{}{} = {}", all.empty() ? "" : ", ", name, lua_text(*value));
            }
        }
        return all;
    }

    // "controller.out" or "rtm:ConsoleIn0.out"; "" if a behaviour in the system file has no such port in this
    // direction.
    std::string end_text(const ProfiledEnd& end, Direction direction) {
        const auto known = known_.find(end.instance);
        if (known == known_.end()) {
            const std::string path = fmt::format("rtm:{}.{}", end.instance, end.port);
            return openrtm::rtm_path(path) ? path : "";
        }
        for (const PortDeclaration& port : known->second.script->ports()) {
            if (port.name == end.port && port.direction == direction) return known->second.name + "." + port.name;
        }
        return "";
    }

    void write_connection(const ProfiledEnd& from, const ProfiledEnd& to) {
        const auto text = [&](const ProfiledEnd& source, const ProfiledEnd& target) {
            const std::string begin = end_text(source, Direction::out), end = end_text(target, Direction::in);
            const bool is_ours = known_.contains(source.instance) || known_.contains(target.instance);
            if (begin.empty() || end.empty() || !is_ours) return std::string();
            for (const std::string& instance : {source.instance, target.instance}) {
                const auto known = known_.find(instance);
                const bool is_outside = !known_.contains(source.instance) || !known_.contains(target.instance);
                if (known != known_.end() && is_outside && !contains(exported_, known->second.name)) {
                    exported_.push_back(known->second.name);
                }
            }
            return fmt::format("connect({}, {})\n", lua_quoted(begin), lua_quoted(end));
        };
        std::string connection = text(from, to);
        if (connection.empty()) connection = text(to, from);  // editors write either end first
        if (connection.empty()) {
            remarks_.push_back(fmt::format("connection of {}.{} to {}.{}", shown(from.instance), shown(from.port),
                                           shown(to.instance), shown(to.port)));
        } else if (connections_.find(connection) == std::string::npos) {
            connections_ += connection;
        }
    }

    const SystemProfile& profile_;
    const BehaviorFinder& find_;
    std::vector<std::string>& remarks_;
    std::map<std::string, Known> known_;  // by instance
    std::vector<std::string> names_, exported_;
    std::string behaviors_, connections_;
};

}  // namespace

std::string system_text_of(const SystemProfile& profile, const BehaviorFinder& find,
                           std::vector<std::string>& remarks) {
    return SystemWriter(profile, find, remarks).write();
}

}  // namespace nezumi::cli
