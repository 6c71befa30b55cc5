// Reads, checks and writes `rtm { ... }`.
#include "bindings/openrtm/rtm_word.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bindings/openrtm/rtc_profiles.hpp"
#include "bindings/openrtm/rtm_wiring.hpp"
#include "engine/base/list.hpp"
#include "engine/base/lua_text.hpp"
#include "engine/records/write_record.hpp"
#include "engine/values/value_text.hpp"

namespace nezumi::openrtm {
namespace {

// "name" of "name.port".
std::string component_of(const std::string& path) { return path.substr(0, path.find('.')); }

// Why an entry of `rename` is invalid; "" if it is valid.
std::string problem_of(const RtmSpec& rtm, const std::string& path, const Value& name) {
    const auto* text = name.get_if<std::string>();
    if (text == nullptr) return fmt::format("expected a port's name as a string, got {}", lua_text(name));
    if (!rtm_path("rtm:x." + *text) || text->find('.') != std::string::npos || text->find('/') != std::string::npos)
        return fmt::format("'{}' is not the name of a port", shown(*text));
    const std::string component = component_of(path);
    if (path.find('.') == std::string::npos || !contains(rtm.exported, component))
        return "expected \"name.port\" of a component that is exported";
    return "";
}

std::string names_text(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "{ " : ", ") + lua_quoted(name);
    return text + " }";
}

}  // namespace

void RtmWord::complete(RtmSpec& given, Fields& fields, const PeerCall& /*call*/) const {
    FieldCheck& check = fields.check();
    auto& servers = given.nameservers;
    if (servers.empty()) check.wrong_at({"nameserver"}, "field 'nameserver' expected at least one \"HOST:PORT\"");
    for (auto server = servers.begin(); server != servers.end(); ++server) {
        if (const std::string problem = adopt_nameserver(*server); !problem.empty()) {
            check.wrong_at({"nameserver"}, "field 'nameserver' " + problem);
        } else if (std::find(servers.begin(), server, *server) != server) {
            check.wrong_at({"nameserver"}, fmt::format("field 'nameserver' has '{}' twice", *server));
        }
    }
    for (const auto& [path, name] : given.rename) {
        const std::string problem = problem_of(given, path, name);
        if (!problem.empty())
            check.wrong_at({"rename", path}, fmt::format("field 'rename' gives '{}' another name: {}", path, problem));
    }
    for (auto name = given.exported.begin(); name != given.exported.end(); ++name) {
        if (std::find(given.exported.begin(), name, *name) != name)
            check.wrong_at({"export"}, fmt::format("field 'export' has '{}' twice", shown(*name)));
    }
}

std::string RtmWord::text_of(const RtmSpec& given) const {
    std::string lists;  // which write_record leaves out
    const auto add = [&](std::string_view field, const std::vector<std::string>& names) {
        lists += fmt::format("{}{} = {}", lists.empty() ? "{ " : ", ", field, names_text(names));
    };
    if (!given.exported.empty()) add("export", given.exported);
    if (given.nameservers != RtmSpec{}.nameservers) add("nameserver", given.nameservers);
    const std::string own = write_record(given);
    if (lists.empty()) return fmt::format("rtm {}\n", own);
    return fmt::format("rtm {}{}\n", lists, own == "{}" ? " }" : ", " + own.substr(2));
}

Expected<void> RtmWord::check(const SystemSpec& system) const {
    const RtmSpec* rtm = find(system);
    std::vector<std::string_view> names;
    for (const Entry& entry : system.entries) names.push_back(name_of(entry));
    if (rtm != nullptr) {
        for (const std::string& name : rtm->exported) {
            if (contains(names, name)) continue;
            return failure(fmt::format("rtm: field 'export': there is no component '{}'{}", shown(name),
                                       did_you_mean(name, names)),
                           rtm->place);
        }
    }
    for (const ConnectionSpec& connection : system.connections) {
        const bool is_from = is_rtm_path(connection.from);
        if (!is_from && !is_rtm_path(connection.to)) continue;
        const std::string& ours = is_from ? connection.to : connection.from;
        const std::string component = component_of(ours);
        if (!contains(names, component)) {
            return failure(
                fmt::format("connect: there is no component '{}'{}", component, did_you_mean(component, names)),
                connection.place);
        }
        const bool is_exported = rtm != nullptr && contains(rtm->exported, component);
        if (is_exported) continue;
        return failure("connect: " + needs_export(is_from ? connection.from : connection.to, component),
                       connection.place);
    }
    return {};
}

void RtmWord::remove_missing(SystemSpec& system) const {
    const RtmSpec* rtm = find(system);
    if (rtm == nullptr) return;
    RtmSpec rest = *rtm;
    const auto is_missing = [&](const std::string& name) {
        return std::none_of(system.entries.begin(), system.entries.end(),
                            [&](const Entry& entry) { return name_of(entry) == name; });
    };
    if (std::erase_if(rest.exported, is_missing) > 0) put(system, std::move(rest));
}

void RtmWord::note_added(SystemSpec& system, std::string_view component, const Actor& who) const {
    const RtmSpec* rtm = find(system);
    if (rtm == nullptr || who != rtm_actor) return;
    if (contains(rtm->exported, component)) return;
    RtmSpec more = *rtm;
    more.exported.emplace_back(component);
    put(system, std::move(more));
}

Expected<void> RtmWord::check_port(std::string_view end) const {
    return rtm_path(end).map([](const RtmPath&) {});
}

Expected<void> RtmWord::check_connection(const System& system, const PeerSpec* spec,
                                         const ConnectionSpec& connection) const {
    const auto ends = rtm_ends(system, connection);
    if (!ends) return Unexpected(ends.error());
    const std::string component = component_of(ends->ours);
    if (spec != nullptr) {
        const auto& exported = static_cast<const Spec*>(spec)->given.exported;
        if (contains(exported, component)) return {};
    }
    return failure(needs_export(ends->ours == connection.from ? connection.to : connection.from, component));
}

Expected<void> RtmWord::check_built(const System& system, const PeerSpec& spec) const {
    const auto profiles = profiles_of(system, static_cast<const Spec&>(spec).given);
    if (!profiles) return Unexpected(profiles.error());
    return {};
}

const RtmWord& rtm_word() {
    static const RtmWord word;
    return word;
}

}  // namespace nezumi::openrtm
