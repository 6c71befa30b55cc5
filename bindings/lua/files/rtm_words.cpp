// The word `rtm`: components that are exported as RTCs, and connections of their ports.
#include <fmt/format.h>

#include <algorithm>

#include "bindings/lua/files/read_record.hpp"
#include "bindings/lua/files/system_words.hpp"
#include "engine/system/rtm_wiring.hpp"
#include "engine/system/system_fields.hpp"
#include "engine/values/value_text.hpp"

namespace nezumi {
namespace {

// "name" of "name.port".
std::string component_of(const std::string& path) { return path.substr(0, path.find('.')); }

// The error of a port's other name; "" if there is none.
std::string problem_of(const RtmSpec& rtm, const std::string& path, const Value& name) {
    const auto* text = name.get_if<std::string>();
    if (text == nullptr) return fmt::format("expected a port's name there, got {}", lua_text(name));
    if (!rtm_path("rtm:x." + *text) || text->find('.') != std::string::npos || text->find('/') != std::string::npos)
        return fmt::format("'{}' is not the name of a port", shown(*text));
    const std::string component = component_of(path);
    if (path.find('.') == std::string::npos ||
        std::find(rtm.exported.begin(), rtm.exported.end(), component) == rtm.exported.end())
        return "expected \"name.port\" of a component that is exported";
    return "";
}

}  // namespace

Expected<void> SystemWords::rtm(const WordCall& call, const Value& value) {
    FieldCheck check = check_of(call, value);
    Fields fields(check, value);
    RtmSpec given;
    given.place = call.place;
    read_record(fields, given);
    fields.done();
    for (const auto& [path, name] : given.rename) {
        const std::string problem = problem_of(given, path, name);
        if (!problem.empty())
            check.wrong_at({"rename", path}, fmt::format("field 'rename' gives '{}' another name: {}", path, problem));
    }
    for (auto name = given.exported.begin(); name != given.exported.end(); ++name) {
        if (std::find(given.exported.begin(), name, *name) != name)
            check.wrong_at({"export"}, fmt::format("field 'export' has '{}' twice", shown(*name)));
    }
    if (auto ok = check.result(); !ok) return ok;
    if (spec_.rtm) return repeated(call, spec_.rtm->place);
    spec_.rtm = std::move(given);
    return {};
}

Expected<void> SystemWords::check_rtm() const {
    std::vector<std::string_view> names;
    for (const Entry& entry : spec_.entries) names.push_back(name_of(entry));
    if (spec_.rtm) {
        for (const std::string& name : spec_.rtm->exported) {
            if (std::find(names.begin(), names.end(), name) != names.end()) continue;
            return failure(fmt::format("rtm: field 'export': there is no component '{}'{}", shown(name),
                                       did_you_mean(name, names)),
                           spec_.rtm->place);
        }
    }
    for (const ConnectionSpec& connection : spec_.connections) {
        const bool is_from = is_rtm_path(connection.from);
        if (!is_from && !is_rtm_path(connection.to)) continue;
        const std::string& ours = is_from ? connection.to : connection.from;
        const std::string component = component_of(ours);
        if (std::find(names.begin(), names.end(), component) == names.end()) {
            return failure(
                fmt::format("connect: there is no component '{}'{}", component, did_you_mean(component, names)),
                connection.place);
        }
        const bool is_exported = spec_.rtm && std::find(spec_.rtm->exported.begin(), spec_.rtm->exported.end(),
                                                        component) != spec_.rtm->exported.end();
        if (is_exported) continue;
        return failure("connect: " + needs_export(is_from ? connection.from : connection.to, component),
                       connection.place);
    }
    return {};
}

}  // namespace nezumi
