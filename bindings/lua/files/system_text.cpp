// Writes every part of a system as a call of its word.
#include "bindings/lua/files/system_text.hpp"

#include <fmt/format.h>

#include <map>
#include <string>
#include <vector>

#include "bindings/lua/files/write_record.hpp"
#include "engine/base/lua_text.hpp"
#include "engine/system/system_fields.hpp"

namespace nezumi {
namespace {

template <Recorded T>
std::string thing(const T& spec) {
    return fmt::format("{} {}", Describe<T>::name, write_record(spec));
}

template <Recorded T>
std::string table_of(const T& entry) {
    return write_record(entry);
}

// A robot with the fields of a robot file that differ from its model.
std::string table_of(const RobotEntry& entry) {
    std::string own = write_record(entry);
    if (entry.changes.empty()) return own;
    return fmt::format("{}, {}", std::string_view(own).substr(0, own.size() - 2),
                       std::string_view(entry.changes).substr(2));
}

std::string thing(const LineSpec& line) {
    std::string points;
    for (const Point2D& point : line.points) points += (points.empty() ? "{ " : ", ") + setting_text(point);
    const std::string own = write_record(line);
    return fmt::format("line {{ points = {} }}{}", points, own == "{}" ? " }" : ", " + own.substr(2));
}

std::string arena(const ArenaSpec& arena) {
    std::vector<std::string> parts;
    const std::string own = write_record(arena);
    if (own != "{}") parts.push_back(own.substr(2, own.size() - 4));
    for (const BoxSpec& box : arena.boxes) parts.push_back(thing(box));
    for (const CylinderSpec& cylinder : arena.cylinders) parts.push_back(thing(cylinder));
    for (const MarkerSpec& marker : arena.markers) parts.push_back(thing(marker));
    if (arena.floor) parts.push_back(thing(*arena.floor));
    for (const LineSpec& line : arena.lines) parts.push_back(thing(line));
    if (parts.empty()) return "";
    std::string text = "arena {\n";
    for (const std::string& part : parts) text += "  " + part + ",\n";
    return text + "}\n\n";
}

// Entries of `publish` or `subscribe`: a name or a table; a list for a port with several topics.
std::string topics(std::string_view field, const std::vector<RosTopic>& all) {
    const bool publishes = field == "publish";
    std::map<std::string, std::vector<std::string>> by_name;
    for (const RosTopic& each : all) {
        RosTopic own = each;
        (publishes ? own.port : own.topic).clear();
        const bool named = own.type.empty() && own.frame.empty();
        by_name[publishes ? each.port : each.topic].push_back(named ? lua_quoted(publishes ? each.topic : each.port)
                                                                    : write_record(own));
    }
    std::string text;
    for (const auto& [name, entries] : by_name) {
        const std::string list = fmt::format("{}", fmt::join(entries, ", "));
        text += fmt::format("    [{}] = {},\n", lua_quoted(name), entries.size() == 1 ? list : "{ " + list + " }");
    }
    return text.empty() ? "" : fmt::format("  {} = {{\n{}  }},\n", field, text);
}

// The fields of `network` or `ros` except the topics.
template <Recorded T>
std::string place_in_domain(const T& spec) {
    const std::string own = write_record(spec);
    std::string text = own.substr(2, own.size() - 4);
    const auto add = [&](std::string_view field, const std::vector<std::string>& names) {
        std::string list;
        for (const std::string& name : names) list += (list.empty() ? "" : ", ") + lua_quoted(name);
        if (!list.empty()) text += fmt::format(", {} = {{ {} }}", field, list);
    };
    add("peers", spec.peers);
    if constexpr (std::is_same_v<T, NetworkSpec>) add("hosts", spec.hosts);
    return text;
}

std::string ros(const RosSpec& spec) {
    return fmt::format("ros {{\n  {},\n{}{}}}\n", place_in_domain(spec), topics("publish", spec.publish),
                       topics("subscribe", spec.subscribe));
}

std::string rtm(const RtmSpec& rtm) {
    std::string names;
    for (const std::string& name : rtm.exported) names += (names.empty() ? "{ " : ", ") + lua_quoted(name);
    const std::string own = write_record(rtm);
    if (names.empty()) return fmt::format("rtm {}\n", own);
    return fmt::format("rtm {{ export = {} }}{}\n", names, own == "{}" ? " }" : ", " + own.substr(2));
}

}  // namespace

std::string write_system_text(const SystemSpec& spec, const std::string& title) {
    std::string text = "--- ";
    for (const char c : title) text += c == '\n' || c == '\r' ? ' ' : c;
    text += "\n";
    if (spec.seed) text += fmt::format("seed({})\n", *spec.seed);
    const SystemSpec plain;
    if (spec.rate != plain.rate) text += fmt::format("rate({})\n", lua_number(spec.rate));
    if (spec.physics_step != plain.physics_step) text += thing(PhysicsFields{spec.physics_step}) + "\n";
    if (spec.network) text += fmt::format("network {{ {} }}\n", place_in_domain(*spec.network));
    if (spec.ros) text += ros(*spec.ros);
    text += "\n" + arena(spec.arena);
    for (const Entry& each : spec.entries) {
        std::visit(
            [&]<class T>(const T& entry) {
                text += fmt::format("{}({}, {})\n", Describe<T>::name, lua_quoted(entry.name), table_of(entry));
            },
            each);
    }
    if (spec.rtm) text += "\n" + rtm(*spec.rtm);
    text += spec.connections.empty() ? "" : "\n";
    for (const ConnectionSpec& connection : spec.connections)
        text += fmt::format("connect({}, {})\n", lua_quoted(connection.from), lua_quoted(connection.to));
    return text;
}

}  // namespace nezumi
