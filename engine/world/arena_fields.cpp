// Checks and conversions of an arena's fields.
#include "engine/world/arena_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "engine/base/names.hpp"

namespace nezumi {

BoxSpec box_of(const WallSpec& wall) {
    const double x = wall.to.x - wall.from.x, y = wall.to.y - wall.from.y;
    BoxSpec box;
    box.at = {(wall.from.x + wall.to.x) / 2, (wall.from.y + wall.to.y) / 2, wall.height / 2};
    box.size = {std::hypot(x, y), wall.thickness, wall.height};
    box.yaw = std::atan2(y, x);
    box.color = wall.color;
    box.place = wall.place;
    return box;
}

std::string adopt_color(std::string& text) {
    const bool hex = text.size() == 7 && text[0] == '#' &&
                     std::all_of(text.begin() + 1, text.end(), [](unsigned char c) { return std::isxdigit(c) != 0; });
    if (hex) return "";
    std::vector<std::string_view> names;
    for (const NamedColor& color : named_colors) {
        if (color.name == text) {
            text = color.hex;
            return "";
        }
        names.push_back(color.name);
    }
    return fmt::format("expected \"#rrggbb\" or the name of a colour, got '{}'{}", text, did_you_mean(text, names));
}

std::string adopt_identifier(std::string& text) {
    if (is_identifier(text)) return "";
    return fmt::format("expected letters, digits and _, not beginning with a digit, and no keyword of Lua, got '{}'",
                       text);
}

Expected<void> check_arena(const ArenaSpec& arena) {
    auto ok = check_record(arena, {});
    const auto check_all = [&ok](const auto& things) {
        for (const auto& thing : things) {
            if (ok) ok = check_record(thing, thing.place);
        }
    };
    check_all(arena.boxes);
    check_all(arena.cylinders);
    check_all(arena.markers);
    check_all(arena.lines);
    if (ok && arena.floor) ok = check_record(*arena.floor, arena.floor->place);
    return ok;
}

}  // namespace nezumi
