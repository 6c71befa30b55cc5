// Every part of a system as the call of the word that makes it.
#include "bindings/lua/files/system_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <type_traits>
#include <vector>

#include "engine/base/names.hpp"

namespace nezumi {
namespace {

// The shortest text that reads back as the same number.
std::string number(double value) {
    std::string text = fmt::format("{}", value);
    if (text.find_first_of(".e") == std::string::npos) text += ".0";
    return text;
}

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            out += '\\';
            out += c;
        } else if (byte < 0x20 || byte == 0x7f) {
            out += fmt::format("\\x{:02x}", byte);
        } else {
            out += c;
        }
    }
    return out + "\"";
}

std::string point(const Point2D& p) { return fmt::format("{{ {}, {} }}", number(p.x), number(p.y)); }
std::string point(const Point3D& p) { return fmt::format("{{ {}, {}, {} }}", number(p.x), number(p.y), number(p.z)); }

// The fields of a table, those only that differ from what a reader would take without them.
class FieldText {
public:
    FieldText& always(const std::string& name, const std::string& value) {
        text_ += (text_.empty() ? "" : ", ") + name + " = " + value;
        return *this;
    }
    FieldText& unless(bool is_default, const std::string& name, const std::string& value) {
        return is_default ? *this : always(name, value);
    }
    std::string table() const { return text_.empty() ? "{}" : "{ " + text_ + " }"; }
    bool empty() const { return text_.empty(); }

private:
    std::string text_;
};

std::string key(const std::string& name) { return is_identifier(name) ? name : "[" + quoted(name) + "]"; }

std::string values(const ParameterValues& values) {
    FieldText fields;
    for (const auto& [name, value] : values) fields.always(key(name), to_lua(value));
    return fields.table();
}

std::string entry(const RobotEntry& robot) {
    FieldText limits;
    const auto limit = [&](const char* name, const std::optional<double>& value) {
        if (value) limits.always(name, number(*value));
    };
    limit("speed", robot.speed);
    limit("yaw_rate", robot.yaw_rate);
    limit("acceleration", robot.acceleration);
    limit("yaw_acceleration", robot.yaw_acceleration);
    const std::string pose = FieldText()
                                 .always("x", number(robot.pose.position.x))
                                 .always("y", number(robot.pose.position.y))
                                 .always("heading", number(robot.pose.heading))
                                 .table();
    return fmt::format("robot({}, {})\n", quoted(robot.name),
                       FieldText()
                           .always("model", quoted(robot.model))
                           .always("pose", pose)
                           .unless(limits.empty(), "limits", limits.table())
                           .unless(robot.backend.empty(), "backend", quoted(robot.backend))
                           .unless(robot.active, "active", "false")
                           .table());
}

std::string entry(const BehaviorEntry& behavior) {
    FieldText sets;
    for (const auto& [name, set] : behavior.sets) sets.always(key(name), values(set));
    return fmt::format("behavior({}, {})\n", quoted(behavior.name),
                       FieldText()
                           .always("script", quoted(behavior.script))
                           .unless(behavior.config.empty(), "config", values(behavior.config))
                           .unless(sets.empty(), "sets", sets.table())
                           .unless(behavior.set.empty(), "set", quoted(behavior.set))
                           .unless(behavior.rate == 0, "rate", number(behavior.rate))
                           .unless(behavior.active, "active", "false")
                           .table());
}

std::string entry(const ComponentEntry& component) {
    return fmt::format("component({}, {})\n", quoted(component.name),
                       FieldText()
                           .always("type", quoted(component.type))
                           .unless(component.config.empty(), "config", values(component.config))
                           .unless(component.rate == 0, "rate", number(component.rate))
                           .unless(component.on.empty(), "on", quoted(component.on))
                           .unless(component.at == Point3D{}, "at", point(component.at))
                           .unless(component.yaw == 0, "yaw", number(component.yaw))
                           .unless(component.active, "active", "false")
                           .table());
}

std::string thing(const BoxSpec& box) {
    return "box " + FieldText()
                        .always("at", point(box.at))
                        .always("size", point(box.size))
                        .unless(box.yaw == 0, "yaw", number(box.yaw))
                        .unless(box.pitch == 0, "pitch", number(box.pitch))
                        .unless(box.mass == 0, "mass", number(box.mass))
                        .unless(box.color == BoxSpec{}.color, "color", quoted(box.color))
                        .table();
}

std::string thing(const CylinderSpec& cylinder) {
    return "cylinder " + FieldText()
                             .always("at", point(cylinder.at))
                             .always("radius", number(cylinder.radius))
                             .always("height", number(cylinder.height))
                             .unless(cylinder.mass == 0, "mass", number(cylinder.mass))
                             .unless(cylinder.color == CylinderSpec{}.color, "color", quoted(cylinder.color))
                             .table();
}

std::string thing(const MarkerSpec& marker) {
    return "marker " + FieldText()
                           .always("name", quoted(marker.name))
                           .always("id", std::to_string(marker.id))
                           .always("size", number(marker.size))
                           .always("at", point(marker.at))
                           .always("facing", number(marker.facing))
                           .table();
}

std::string thing(const FloorSpec& floor) {
    return "floor " + FieldText().always("image", quoted(floor.image)).always("size", point(floor.size)).table();
}

std::string arena(const ArenaSpec& arena) {
    std::vector<std::string> parts;
    if (arena.size) parts.push_back("size = " + point(*arena.size));
    const ArenaSpec plain;
    if (!arena.border) {
        parts.emplace_back("border = false");
    } else if (arena.border_thickness != plain.border_thickness || arena.border_height != plain.border_height) {
        parts.push_back(fmt::format("border = {{ thickness = {}, height = {} }}", number(arena.border_thickness),
                                    number(arena.border_height)));
    }
    for (const BoxSpec& box : arena.boxes) parts.push_back(thing(box));
    for (const CylinderSpec& cylinder : arena.cylinders) parts.push_back(thing(cylinder));
    for (const MarkerSpec& marker : arena.markers) parts.push_back(thing(marker));
    if (arena.floor) parts.push_back(thing(*arena.floor));
    if (parts.empty()) return "";
    std::string text = "arena {\n";
    for (const std::string& part : parts) text += "  " + part + ",\n";
    return text + "}\n\n";
}

}  // namespace

std::string to_lua(const ParameterValue& value) {
    return std::visit(
        [](const auto& v) -> std::string {
            using T = std::decay_t<decltype(v)>;
            if constexpr (std::is_same_v<T, std::string>) {
                return quoted(v);
            } else if constexpr (std::is_same_v<T, double>) {
                return number(v);
            } else if constexpr (std::is_arithmetic_v<T>) {
                return fmt::format("{}", v);
            } else {
                std::string text;
                for (std::size_t i = 0; i < v.size(); ++i) {
                    text += (i > 0 ? ", " : " ") + to_lua(ParameterValue(static_cast<typename T::value_type>(v[i])));
                }
                return text.empty() ? "{}" : "{" + text + " }";
            }
        },
        value);
}

std::string write_system_text(const SystemSpec& spec, const std::string& title) {
    std::string text = "--- ";
    for (const char c : title) text += c == '\n' || c == '\r' ? ' ' : c;
    text += "\n";
    if (spec.seed) text += fmt::format("seed({})\n", *spec.seed);
    const SystemSpec plain;
    if (spec.rate != plain.rate) text += fmt::format("rate({})\n", number(spec.rate));
    if (spec.physics_step != plain.physics_step)
        text += fmt::format("physics {{ step = {} }}\n", number(spec.physics_step));
    text += "\n" + arena(spec.arena);
    for (const Entry& each : spec.entries) {
        text += std::visit([](const auto& e) { return entry(e); }, each);
    }
    text += spec.connections.empty() ? "" : "\n";
    for (const ConnectionSpec& connection : spec.connections) {
        text += fmt::format("connect({}, {})\n", quoted(connection.from), quoted(connection.to));
    }
    return text;
}

}  // namespace nezumi
