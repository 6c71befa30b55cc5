// Boxes, walls, cylinders, markers, the floor and maps of a system file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bindings/lua/files/file_fields.hpp"
#include "bindings/lua/files/system_words.hpp"
#include "engine/base/names.hpp"

namespace nezumi {
namespace {

constexpr double wall_thickness = 0.02;  // [m] as an arena's border
constexpr double wall_height = 0.1;      // [m] as an arena's border
constexpr std::int64_t last_tag = 586;   // AprilTag family 36h11 has 587 tags
constexpr double least_length = 1e-4;    // [m] thinner things have no physics
constexpr double least_mass = 1e-3;      // [kg] what is lighter is thrown about by rounding

struct NamedColor {
    std::string_view name;
    std::string_view hex;
};
constexpr NamedColor colors[] = {
    {"black", "#1c1c1c"},  {"white", "#f5f5f5"}, {"gray", "#8a8f98"},   {"grey", "#8a8f98"},   {"red", "#d6453d"},
    {"green", "#3f9b4f"},  {"blue", "#3568c4"},  {"yellow", "#e8c33c"}, {"orange", "#e08a2e"}, {"brown", "#7a5230"},
    {"purple", "#8550a8"}, {"pink", "#e58fb1"},  {"cyan", "#3fb0c0"}};

void read_color(Fields& fields, std::string& out) {
    std::string text;
    if (!fields.text("color", text)) return;
    const bool hex = text.size() == 7 && text[0] == '#' &&
                     std::all_of(text.begin() + 1, text.end(), [](unsigned char c) { return std::isxdigit(c) != 0; });
    if (hex) {
        out = text;
        return;
    }
    std::vector<std::string_view> names;
    for (const NamedColor& color : colors) {
        if (color.name == text) {
            out = color.hex;
            return;
        }
        names.push_back(color.name);
    }
    fields.check().wrong(
        fields.path_of("color"),
        fmt::format("expected \"#rrggbb\" or the name of a colour, got '{}'{}", text, did_you_mean(text, names)));
}

void read_length(Fields& fields, std::string_view name, double& out) {
    if (fields.number(name, out, NumberRange::positive) && out < least_length) {
        fields.check().wrong(fields.path_of(name), fmt::format("expected at least {} m, got {}", least_length, out));
    }
}

void read_mass(Fields& fields, double& out) {
    if (fields.number("mass", out, NumberRange::not_negative) && out > 0 && out < least_mass) {
        fields.check().wrong(fields.path_of("mass"),
                             fmt::format("expected at least {} kg, or 0 for what is fixed, got {}", least_mass, out));
    }
}

BoxSpec read_box(Fields& fields) {
    BoxSpec box;
    fields.require("at", "{ x, y, z } of the centre in metres");
    fields.require("size", "{ length, width, height } in metres");
    if (fields.point("size", box.size, NumberRange::positive) &&
        std::min({box.size.x, box.size.y, box.size.z}) < least_length) {
        fields.check().wrong(fields.path_of("size"), fmt::format("expected lengths of at least {} m", least_length));
    }
    box.at.z = box.size.z / 2;  // a box whose height nobody gave stands on the floor
    fields.point("at", box.at, NumberRange::any, true);
    fields.number("yaw", box.yaw);
    read_mass(fields, box.mass);
    if (fields.number("pitch", box.pitch) && box.pitch != 0 && box.mass > 0) {
        fields.check().wrong(fields.path_of("pitch"), "is for a box without mass: a movable one stands level");
    }
    read_color(fields, box.color);
    return box;
}

BoxSpec read_wall(Fields& fields) {
    Point2D from;
    Point2D to;
    double thickness = wall_thickness;
    double height = wall_height;
    fields.require("from", "{ x, y } in metres");
    fields.require("to", "{ x, y } in metres");
    const bool both = fields.point("from", from) && fields.point("to", to);
    read_length(fields, "height", height);
    read_length(fields, "thickness", thickness);
    BoxSpec box;
    read_color(fields, box.color);
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    if (both && length < least_length) {
        fields.check().wrong_at(fields.path_of("to"),
                                "'from' and 'to' are the same place: expected a wall with a length");
    }
    box.at = {(from.x + to.x) / 2, (from.y + to.y) / 2, height / 2};
    box.size = {length, thickness, height};
    box.yaw = std::atan2(to.y - from.y, to.x - from.x);
    return box;
}

CylinderSpec read_cylinder(Fields& fields) {
    CylinderSpec cylinder;
    fields.require("at", "{ x, y, z } of the centre in metres");
    fields.require("radius", "metres");
    fields.require("height", "metres");
    read_length(fields, "radius", cylinder.radius);
    read_length(fields, "height", cylinder.height);
    cylinder.at.z = cylinder.height / 2;
    fields.point("at", cylinder.at, NumberRange::any, true);
    read_mass(fields, cylinder.mass);
    read_color(fields, cylinder.color);
    return cylinder;
}

MarkerSpec read_marker(Fields& fields) {
    MarkerSpec marker;
    std::int64_t id = 0;
    fields.require("id", fmt::format("a tag's number from 0 to {}", last_tag));
    fields.whole("id", id, 0, last_tag);
    marker.id = static_cast<int>(id);
    marker.name = fmt::format("marker_{}", id);
    if (fields.text("name", marker.name) && !is_identifier(marker.name)) {
        fields.check().wrong(fields.path_of("name"),
                             fmt::format("expected letters, digits and _, got '{}'", marker.name));
    }
    read_length(fields, "size", marker.size);
    fields.require("at", "{ x, y, z } of the centre in metres");
    fields.point("at", marker.at);
    fields.number("facing", marker.facing);
    return marker;
}

std::string hint_for_arena(std::string_view name) {
    for (const std::string_view word : {"box", "wall", "cylinder", "marker", "floor", "csv"}) {
        if (name == word)
            return fmt::format(": write {0} {1}, without =", word, word == "csv" ? "\"map.csv\"" : "{ ... }");
    }
    return "";
}

}  // namespace

Expected<FileThing> SystemWords::thing(const WordCall& call, const FileValue& value) {
    if (call.word == "csv") {
        auto boxes = read_map(call, value);
        if (!boxes) return Unexpected(boxes.error());
        things_.push_back({call, std::move(*boxes)});
        return FileThing{things_.size() - 1};
    }
    FieldCheck check(call.word, call.word, call.place, call.source);
    Fields fields(check, value);
    Made made;
    const auto put = [&](auto spec) {
        spec.place = call.place;
        return spec;
    };
    if (call.word == "box") {
        made = std::vector{put(read_box(fields))};
    } else if (call.word == "wall") {
        made = std::vector{put(read_wall(fields))};
    } else if (call.word == "cylinder") {
        made = put(read_cylinder(fields));
    } else if (call.word == "marker") {
        made = put(read_marker(fields));
    } else {
        FloorSpec floor;
        fields.require("image", "a picture's file");
        fields.require("size", "{ x, y } in metres");
        fields.text("image", floor.image);
        fields.point("size", floor.size, NumberRange::positive);
        if (check.ok() && fields.has("image")) {
            if (const auto path = project_.find(FileKind::data, floor.image, call.place.file)) {
                floor.image = path->string();
                note_file(project_.shown(*path));
            } else {
                check.wrong_at({"image"}, path.error().message);
            }
        }
        made = put(std::move(floor));
    }
    fields.done();
    if (auto ok = check.result(); !ok) return Unexpected(ok.error());
    things_.push_back({call, std::move(made)});
    return FileThing{things_.size() - 1};
}

Expected<std::vector<BoxSpec>> SystemWords::read_map(const WordCall& call, const FileValue& name) {
    const std::string* file = name.text();
    if (file == nullptr) return failure(fmt::format("csv: expected a file's name, got {}", kind_of(name)), call.place);
    const auto path = project_.find(FileKind::data, *file, call.place.file);
    if (!path) return failure("csv: " + path.error().message, call.place);
    const std::string shown = project_.shown(*path);
    const auto text = read_text_file(*path, shown);
    if (!text) return Unexpected(text.error());
    note_file(shown);
    return read_csv_map(*text, shown);
}

Expected<void> SystemWords::place_things(const WordCall& call, const std::vector<FileValue>& elements) {
    std::size_t number = 0;
    for (const FileValue& element : elements) {
        ++number;
        // A list of things is as good as the things.
        if (const FileTable* table = element.table(); table != nullptr && table->fields.empty()) {
            if (auto ok = place_things(call, table->elements); !ok) return ok;
            continue;
        }
        const auto* handle = std::get_if<FileThing>(&element.data);
        if (handle == nullptr || handle->index >= things_.size()) {
            return failure(fmt::format("arena: element {} is no box, wall, cylinder, marker, floor or csv, but a {}",
                                       number, kind_of(element)),
                           call.place);
        }
        Thing& thing = things_[handle->index];
        if (thing.placed) {
            return failure(fmt::format("arena: the {} of {}:{} is in the arena already", thing.call.word,
                                       thing.call.place.file, thing.call.place.line),
                           call.place);
        }
        thing.placed = true;
        if (auto* boxes = std::get_if<std::vector<BoxSpec>>(&thing.made)) {
            spec_.arena.boxes.insert(spec_.arena.boxes.end(), boxes->begin(), boxes->end());
        } else if (auto* cylinder = std::get_if<CylinderSpec>(&thing.made)) {
            spec_.arena.cylinders.push_back(*cylinder);
        } else if (auto* marker = std::get_if<MarkerSpec>(&thing.made)) {
            for (const MarkerSpec& other : spec_.arena.markers) {
                if (other.name != marker->name) continue;
                return failure(fmt::format("marker: the name '{}' is taken by the marker of {}:{}", marker->name,
                                           other.place.file, other.place.line),
                               marker->place);
            }
            spec_.arena.markers.push_back(*marker);
        } else if (auto* floor = std::get_if<FloorSpec>(&thing.made)) {
            if (spec_.arena.floor) {
                return failure(fmt::format("floor: there is one already, at {}:{}", spec_.arena.floor->place.file,
                                           spec_.arena.floor->place.line),
                               floor->place);
            }
            spec_.arena.floor = *floor;
        }
    }
    return {};
}

Expected<void> SystemWords::arena(const WordCall& call, const FileValue& value) {
    FieldCheck check("arena", call.word, call.place, call.source);
    Fields fields(check, value);
    Point2D size;
    const bool has_size = fields.point("size", size, NumberRange::positive);
    bool border = true;
    double thickness = spec_.arena.border_thickness;
    double height = spec_.arena.border_height;
    const FileValue* border_value = fields.field("border");
    if (border_value != nullptr && border_value->table() != nullptr) {
        Fields inner = fields.inner("border");
        read_length(inner, "thickness", thickness);
        read_length(inner, "height", height);
        inner.done();
    } else {
        fields.boolean("border", border);
    }
    const std::vector<FileValue>& elements = fields.elements();
    fields.done(hint_for_arena);
    if (has_size && size_place_)
        check.wrong(fields.path_of("size"),
                    fmt::format("is set already, at {}:{}", size_place_->file, size_place_->line));
    if (border_value != nullptr && border_place_) {
        check.wrong(fields.path_of("border"),
                    fmt::format("is set already, at {}:{}", border_place_->file, border_place_->line));
    }
    if (auto ok = check.result(); !ok) return ok;
    if (auto ok = place_things(call, elements); !ok) return ok;
    if (has_size) {
        spec_.arena.size = size;
        size_place_ = call.place;
    }
    if (border_value != nullptr) {
        spec_.arena.border = border;
        spec_.arena.border_thickness = thickness;
        spec_.arena.border_height = height;
        border_place_ = call.place;
    }
    return {};
}

}  // namespace nezumi
