// Mazes in a system file: from a contest's file, from a drawing in the system file itself, or generated.
#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <optional>
#include <utility>

#include "bindings/lua/files/system_words.hpp"
#include "engine/records/read_record.hpp"
#include "engine/world/arena_fields.hpp"
#include "engine/world/maze_file.hpp"

namespace nezumi {
namespace {

// The maze of a drawing; nothing if the check of `fields` has an error.
std::optional<Maze> read_rows(Fields& fields, const Value& value) {
    std::vector<std::string> rows;
    const FieldPath path = fields.path_of("rows");
    if (value.get_if<FileTable>() == nullptr || !value.get_if<FileTable>()->fields.empty()) {
        fields.check().wrong(path, fmt::format("expected a list of strings, got {}", kind_of(value)));
        return std::nullopt;
    }
    const auto in_row = [&](std::size_t number) {
        FieldPath place = path;
        if (number > 0) place.push_back(fmt::format("[{}]", number));
        return place;
    };
    for (const Value& element : value.get_if<FileTable>()->elements) {
        const std::string* row = element.get_if<std::string>();
        if (row == nullptr)
            fields.check().wrong(in_row(rows.size() + 1), fmt::format("expected a string, got {}", kind_of(element)));
        rows.push_back(row != nullptr ? *row : "");
    }
    if (!fields.check().ok()) return std::nullopt;
    auto maze = read_drawing(std::move(rows));
    if (maze) return *maze;
    fields.check().wrong(in_row(maze.error().row), maze.error().text);
    return std::nullopt;
}

Value list_of(const std::vector<int>& numbers) {
    FileTable list;
    for (const int number : numbers) list.elements.emplace_back(std::int64_t{number});
    return Value{std::move(list)};
}

// The facts about a maze that a system file can read. Cells are counted from 1, as the behaviours in mazes do.
FileTable facts_of(const Maze& maze, const MazeSpec& spec) {
    const MazeCell start = maze.start();
    std::vector<int> goals;
    for (const MazeCell goal : maze.goals()) {
        goals.push_back(goal.column + 1);
        goals.push_back(goal.row + 1);
    }
    const int side = static_cast<int>(maze.start_side());
    FileTable pose;
    pose.fields = {{"heading", Value{side * std::numbers::pi / 2}},
                   {"x", Value{spec.at.x + start.column * spec.cell}},
                   {"y", Value{spec.at.y + start.row * spec.cell}}};
    FileTable facts;
    facts.fields = {{"columns", Value{std::int64_t{maze.columns()}}},
                    {"direction", Value{std::int64_t{side}}},
                    {"goal", list_of(goals)},
                    {"pose", Value{std::move(pose)}},
                    {"rows", Value{std::int64_t{maze.rows()}}},
                    {"start", list_of({start.column + 1, start.row + 1})}};
    return facts;
}

}  // namespace

Expected<FileThing> SystemWords::make_maze(const WordCall& call, const Value& value) {
    const bool is_name = value.get_if<std::string>() != nullptr;
    const Value none{FileTable{}};
    const Value& table = is_name ? none : value;
    FieldCheck check = check_of(call, table);
    Fields fields(check, table);
    MazeSpec spec;
    spec.place = call.place;
    read_record(fields, spec);
    const Value* rows = fields.field("rows");
    const Value* name = is_name ? &value : nullptr;
    if (!is_name && fields.elements().size() == 1) name = &fields.elements().front();
    std::optional<Maze> maze;
    if ((rows != nullptr || name != nullptr) && fields.has("generate")) {
        check.wrong(fields.path_of("generate"),
                    fmt::format("can be used only in a maze without {}", rows != nullptr ? "'rows'" : "a file"));
    } else if (rows != nullptr && name != nullptr) {
        check.wrong(fields.path_of("rows"), "can be used only in a maze without a file");
    } else if (rows != nullptr) {
        maze = read_rows(fields, *rows);
    } else if (fields.has("generate")) {
        maze = generate_maze(spec.generate);
    } else if (name == nullptr) {
        fields.require("rows", "a drawing, or generate = { columns =, rows =, seed = }; or write maze \"FILE\"");
    }
    if (check.ok() && spec.cell < 2 * spec.thickness) {
        check.wrong(fields.path_of("cell"),
                    fmt::format("expected at least {:g} m, twice the walls' thickness, got {:g}", 2 * spec.thickness,
                                spec.cell));
    }
    fields.done();
    if (auto ok = check.result(); !ok) return Unexpected(ok.error());
    if (name != nullptr) {
        const auto file = read_file(call, *name);
        if (!file) return Unexpected(file.error());
        auto read = read_maze(file->text, file->shown);
        if (!read) return Unexpected(read.error());
        maze = std::move(*read);
    }
    things_.push_back({call, walls_of(*maze, spec), false, facts_of(*maze, spec)});
    return FileThing{things_.size() - 1};
}

// Refuses mazes that exceed the arena by more than the thickness of a wall: outer walls may stand on its edge.
Expected<void> SystemWords::check_mazes() const {
    if (!spec_.arena.size) return {};
    const Point2D& size = *spec_.arena.size;
    for (const Thing& thing : things_) {
        const auto* walls = std::get_if<std::vector<BoxSpec>>(&thing.made);
        if (thing.call.word != "maze" || walls == nullptr) continue;
        Point2D least{walls->front().at.x, walls->front().at.y}, most = least;
        for (const BoxSpec& wall : *walls) {
            least = {std::min(least.x, wall.at.x - wall.size.x / 2), std::min(least.y, wall.at.y - wall.size.y / 2)};
            most = {std::max(most.x, wall.at.x + wall.size.x / 2), std::max(most.y, wall.at.y + wall.size.y / 2)};
        }
        const double slack = std::min(walls->front().size.x, walls->front().size.y);
        if (std::max(-least.x, most.x) <= size.x / 2 + slack && std::max(-least.y, most.y) <= size.y / 2 + slack)
            continue;
        return failure(fmt::format("maze: it reaches from {{ {:.3g}, {:.3g} }} to {{ {:.3g}, {:.3g} }}, out of the "
                                   "arena of {:g} x {:g} m: move it by 'at', or make the arena larger",
                                   least.x, least.y, most.x, most.y, size.x, size.y),
                       thing.call.place);
    }
    return {};
}

}  // namespace nezumi
