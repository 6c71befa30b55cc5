// Boxes, walls, cylinders, markers, the floor and its lines in a system file.
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>

#include "bindings/lua/files/system_words.hpp"
#include "engine/records/read_record.hpp"
#include "engine/world/arena_fields.hpp"

namespace nezumi {
namespace {

// The default z of an object (not a number) means that it stands on the floor.
constexpr double on_the_floor = std::numeric_limits<double>::quiet_NaN();

BoxSpec read_box(Fields& fields) {
    BoxSpec box;
    box.at.z = on_the_floor;
    read_record(fields, box);
    if (std::isnan(box.at.z)) box.at.z = box.size.z / 2;
    if (box.pitch != 0 && box.mass > 0)
        fields.check().wrong(fields.path_of("pitch"),
                             "can be used only for a box without mass: a movable box stands level");
    return box;
}

WallSpec read_wall(Fields& fields) {
    WallSpec wall;
    read_record(fields, wall);
    const double length = std::hypot(wall.to.x - wall.from.x, wall.to.y - wall.from.y);
    if (fields.has("from") && fields.has("to") && length < least_length) {
        fields.check().wrong_at(fields.path_of("to"),
                                "'from' and 'to' are the same place: expected a wall with a length");
    }
    return wall;
}

CylinderSpec read_cylinder(Fields& fields) {
    CylinderSpec cylinder;
    cylinder.at.z = on_the_floor;
    read_record(fields, cylinder);
    if (std::isnan(cylinder.at.z)) cylinder.at.z = cylinder.height / 2;
    return cylinder;
}

MarkerSpec read_marker(Fields& fields) {
    MarkerSpec marker;
    read_record(fields, marker);
    if (!fields.has("name")) marker.name = fmt::format("marker_{}", marker.id);
    return marker;
}

// A position `{ x, y }`; nothing for any other value.
std::optional<Point2D> point_of(const Value& value) {
    const FileTable* table = value.get_if<FileTable>();
    if (table == nullptr || table->elements.size() != 2 || !table->fields.empty()) return std::nullopt;
    const auto x = number_of(table->elements[0]), y = number_of(table->elements[1]);
    if (!x || !y || !(std::abs(*x) <= Rule{}.most) || !(std::abs(*y) <= Rule{}.most)) return std::nullopt;
    return Point2D{*x, *y};
}

LineSpec read_line(Fields& fields) {
    LineSpec line;
    read_record(fields, line);
    const Value* points = fields.field("points");
    const FieldPath path = fields.path_of("points");
    if (points == nullptr) {
        fields.require("points", "{ { x, y }, ... } in m");
        return line;
    }
    const FileTable* table = points->get_if<FileTable>();
    if (table == nullptr || !table->fields.empty()) {
        fields.check().wrong(path, fmt::format("expected a list of {{ x, y }}, got {}", kind_of(*points)));
        return line;
    }
    for (const Value& element : table->elements) {
        const auto point = point_of(element);
        FieldPath place = path;
        place.push_back(fmt::format("[{}]", line.points.size() + 1));
        if (!point) fields.check().wrong(place, "expected { x, y }, two numbers in m");
        line.points.push_back(point.value_or(Point2D{}));
    }
    if (line.points.size() < 2)
        fields.check().wrong(path, fmt::format("expected two points or more, got {}", line.points.size()));
    return line;
}

// Whether a table is a result of `maze`: the object as its only element, and facts about the maze as fields.
bool is_maze(const FileTable& table) {
    return table.elements.size() == 1 && table.elements.front().get_if<FileThing>() != nullptr;
}

std::string hint_for_arena(std::string_view name) {
    for (const std::string_view word : {"box", "wall", "cylinder", "marker", "maze", "floor", "line", "csv", "map"}) {
        if (name == word)
            return fmt::format(": write {0} {1}, without =", word,
                               word == "csv"   ? "\"map.csv\""
                               : word == "map" ? "\"map.yaml\""
                                               : "{ ... }");
    }
    return "";
}

}  // namespace

Expected<FileThing> SystemWords::thing(const WordCall& call, const Value& value) {
    if (call.word == "maze") return make_maze(call, value);
    if (call.word == "csv" || call.word == "map") {
        auto boxes = call.word == "csv" ? read_map(call, value) : read_ros_map(call, value);
        if (!boxes) return Unexpected(boxes.error());
        things_.push_back({call, std::move(*boxes)});
        return FileThing{things_.size() - 1};
    }
    FieldCheck check = check_of(call, value);
    Fields fields(check, value);
    Made made;
    const auto put = [&](auto spec) {
        spec.place = call.place;
        return spec;
    };
    if (call.word == "box") {
        made = std::vector{put(read_box(fields))};
    } else if (call.word == "wall") {
        made = std::vector{box_of(put(read_wall(fields)))};
    } else if (call.word == "cylinder") {
        made = put(read_cylinder(fields));
    } else if (call.word == "marker") {
        made = put(read_marker(fields));
    } else if (call.word == "line") {
        made = put(read_line(fields));
    } else {
        FloorSpec floor;
        read_record(fields, floor);
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
    if (call.word == "box") note_degrees(check, call, "box", "yaw", std::get<std::vector<BoxSpec>>(made).front().yaw);
    if (call.word == "marker") note_degrees(check, call, "marker", "facing", std::get<MarkerSpec>(made).facing);
    things_.push_back({call, std::move(made)});
    return FileThing{things_.size() - 1};
}

Expected<void> SystemWords::place_things(const WordCall& call, const std::vector<Value>& elements) {
    std::size_t number = 0;
    for (const Value& element : elements) {
        ++number;
        // A list of objects is allowed too, and places all of them. The result of `maze` is such a list.
        if (const FileTable* table = element.get_if<FileTable>();
            table != nullptr && (table->fields.empty() || is_maze(*table))) {
            if (auto ok = place_things(call, table->elements); !ok) return ok;
            continue;
        }
        const auto* handle = element.get_if<FileThing>();
        if (handle == nullptr || handle->index >= things_.size()) {
            return failure(fmt::format("arena: element {}: expected a box, wall, cylinder, marker, maze, floor, line, "
                                       "csv or map, got a {}",
                                       number, kind_of(element)),
                           call.place);
        }
        Thing& thing = things_[handle->index];
        if (thing.placed) {
            return failure(fmt::format("arena: the {} at {}:{} is in the arena already", thing.call.word,
                                       thing.call.place.file, thing.call.place.line),
                           call.place);
        }
        thing.placed = true;
        if (auto* boxes = std::get_if<std::vector<BoxSpec>>(&thing.made)) {
            spec_.arena.boxes.insert(spec_.arena.boxes.end(), boxes->begin(), boxes->end());
        } else if (auto* cylinder = std::get_if<CylinderSpec>(&thing.made)) {
            spec_.arena.cylinders.push_back(*cylinder);
        } else if (auto* line = std::get_if<LineSpec>(&thing.made)) {
            spec_.arena.lines.push_back(*line);
        } else if (auto* marker = std::get_if<MarkerSpec>(&thing.made)) {
            for (const MarkerSpec& other : spec_.arena.markers) {
                if (other.name != marker->name) continue;
                return failure(fmt::format("marker: the name '{}' is already used by the marker at {}:{}", marker->name,
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

Expected<void> SystemWords::arena(const WordCall& call, const Value& value) {
    FieldCheck check = check_of(call, value);
    Fields fields(check, value);
    ArenaSpec given;
    read_record(fields, given);
    const bool has_size = fields.has("size"), has_border = fields.has("border");
    const std::vector<Value>& elements = fields.elements();
    fields.done(hint_for_arena);
    if (has_size && size_place_)
        check.wrong(fields.path_of("size"),
                    fmt::format("is set already, at {}:{}", size_place_->file, size_place_->line));
    if (has_border && border_place_) {
        check.wrong(fields.path_of("border"),
                    fmt::format("is set already, at {}:{}", border_place_->file, border_place_->line));
    }
    if (auto ok = check.result(); !ok) return ok;
    if (auto ok = place_things(call, elements); !ok) return ok;
    if (has_size) {
        spec_.arena.size = given.size;
        size_place_ = call.place;
    }
    if (has_border) {
        spec_.arena.border = given.border;
        border_place_ = call.place;
    }
    return {};
}

Expected<void> SystemWords::check_lines() const {
    const ArenaSpec& arena = spec_.arena;
    for (const LineSpec& line : arena.lines) {
        if (!arena.floor && !arena.size)
            return failure("line: there is no floor to paint it on: give the arena a size or a floor", line.place);
        const Point2D canvas = arena.floor ? arena.floor->size : *arena.size;
        for (const Point2D& point : line.points) {
            if (std::abs(point.x) <= canvas.x / 2 && std::abs(point.y) <= canvas.y / 2) continue;
            return failure(fmt::format("line: the point {{ {}, {} }} lies outside of the {}, {} x {} m", point.x,
                                       point.y, arena.floor ? "floor's picture" : "arena", canvas.x, canvas.y),
                           line.place);
        }
    }
    return {};
}

}  // namespace nezumi
