// Writes every part of a system as a call of its word.
#include "bindings/lua/files/system_text.hpp"

#include <fmt/format.h>

#include <vector>

#include "engine/base/lua_text.hpp"
#include "engine/records/write_record.hpp"
#include "engine/system/peer_word.hpp"
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

// The table of a robot, including the fields that differ from the robot's model.
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

// The calls of words that describe peers: at the beginning of the file, or after the components.
std::string peers(const SystemSpec& spec, bool follow) {
    std::string text;
    for (const auto& [name, peer] : spec.peers) {
        if (peer->word().follows_components() == follow) text += (follow ? "\n" : "") + peer->word().text(*peer);
    }
    return text;
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
    text += peers(spec, false);
    text += "\n" + arena(spec.arena);
    for (const Entry& each : spec.entries) {
        std::visit(
            [&]<class T>(const T& entry) {
                text += fmt::format("{}({}, {})\n", Describe<T>::name, lua_quoted(entry.name), table_of(entry));
            },
            each);
    }
    text += peers(spec, true);
    text += spec.connections.empty() ? "" : "\n";
    for (const ConnectionSpec& connection : spec.connections)
        text += fmt::format("connect({}, {})\n", lua_quoted(connection.from), lua_quoted(connection.to));
    return text;
}

}  // namespace nezumi
