// The objects of an arena in a system file: every field with unit, documentation and limits.
#pragma once

#include "engine/ports/setting.hpp"
#include "engine/world/arena_spec.hpp"
#include "engine/world/maze.hpp"
#include "engine/world/picture.hpp"

namespace nezumi {

inline constexpr double least_length = 1e-4;  ///< [m] thinner objects can't be simulated
inline constexpr double least_line = 1e-3;    ///< [m] thinner lines are invisible to sensors
inline constexpr double least_mass = 1e-3;    ///< [kg] lighter objects are unstable because of rounding errors
inline constexpr int last_tag = tag_count - 1;

/// A name of a colour, which a file may use instead of "#rrggbb".
struct NamedColor {
    std::string_view name;
    std::string_view hex;
};
inline constexpr NamedColor named_colors[] = {
    {"black", "#1c1c1c"},  {"white", "#f5f5f5"}, {"gray", "#8a8f98"},   {"grey", "#8a8f98"},   {"red", "#d6453d"},
    {"green", "#3f9b4f"},  {"blue", "#3568c4"},  {"yellow", "#e8c33c"}, {"orange", "#e08a2e"}, {"brown", "#7a5230"},
    {"purple", "#8550a8"}, {"pink", "#e58fb1"},  {"cyan", "#3fb0c0"}};

/// A wall between two points; it becomes a box.
struct WallSpec {
    Point2D from{};           ///< [m]
    Point2D to{};             ///< [m]
    double height = 0.1;      ///< [m]
    double thickness = 0.02;  ///< [m]
    std::string color = BoxSpec{}.color;
    Place place{};
};

BoxSpec box_of(const WallSpec& wall);

/// Replaces the name of a colour by "#rrggbb", and leaves "#rrggbb" unchanged. Returns "", or the error for any other
/// text.
std::string adopt_color(std::string& text);
/// Accepts a Lua identifier: letters, digits and underscores, no keyword. Returns "", or the error for any other text.
std::string adopt_identifier(std::string& text);
/// Checks all numbers of an arena by the rules below, whether it comes from a system file, a map or a program.
Expected<void> check_arena(const ArenaSpec& arena);

template <>
struct Describe<BoxSpec> {
    static constexpr std::string_view name = "box";
    static constexpr std::string_view doc = "A box, fixed or movable.";
    static constexpr FieldList fields{
        Setting{"at", &BoxSpec::at, "m", "centre; without z it stands on the floor", {.required = true, .level = true}},
        Setting{"size",
                &BoxSpec::size,
                "m",
                "length, width, height",
                {.required = true, .range = NumberRange::positive, .least = least_length}},
        Setting{"yaw", &BoxSpec::yaw, "rad", "turn about the vertical, counter-clockwise"},
        Setting{"pitch", &BoxSpec::pitch, "rad", "makes a ramp: a positive one lowers the front; only without a mass"},
        Setting{"color",
                &BoxSpec::color,
                "",
                "\"#rrggbb\" or the name of a colour",
                {.fallback = "\"gray\"", .adopt = adopt_color}},
        Setting{"mass",
                &BoxSpec::mass,
                "kg",
                "a mass makes it movable",
                {.range = NumberRange::not_negative, .least = least_mass}},
        Internal{&BoxSpec::place},
    };
};

template <>
struct Describe<WallSpec> {
    static constexpr std::string_view name = "wall";
    static constexpr std::string_view doc = "A wall on the floor from one place to another.";
    static constexpr FieldList fields{
        Setting{"from", &WallSpec::from, "m", "middle of one end", {.required = true}},
        Setting{"to", &WallSpec::to, "m", "middle of the other end", {.required = true}},
        Setting{"height", &WallSpec::height, "m", "", {.range = NumberRange::positive, .least = least_length}},
        Setting{"thickness", &WallSpec::thickness, "m", "", {.range = NumberRange::positive, .least = least_length}},
        Setting{"color", &WallSpec::color, "", "as of a box", {.fallback = "\"gray\"", .adopt = adopt_color}},
        Internal{&WallSpec::place},
    };
};

template <>
struct Describe<CylinderSpec> {
    static constexpr std::string_view name = "cylinder";
    static constexpr std::string_view doc = "An upright cylinder, fixed or movable.";
    static constexpr FieldList fields{
        Setting{"at",
                &CylinderSpec::at,
                "m",
                "centre; without z it stands on the floor",
                {.required = true, .level = true}},
        Setting{"radius",
                &CylinderSpec::radius,
                "m",
                "",
                {.required = true, .range = NumberRange::positive, .least = least_length}},
        Setting{"height",
                &CylinderSpec::height,
                "m",
                "",
                {.required = true, .range = NumberRange::positive, .least = least_length}},
        Setting{"color", &CylinderSpec::color, "", "as of a box", {.fallback = "\"gray\"", .adopt = adopt_color}},
        Setting{"mass",
                &CylinderSpec::mass,
                "kg",
                "a mass makes it movable",
                {.range = NumberRange::not_negative, .least = least_mass}},
        Internal{&CylinderSpec::place},
    };
};

template <>
struct Describe<MarkerSpec> {
    static constexpr std::string_view name = "marker";
    static constexpr std::string_view doc = "An AprilTag of the family 36h11, without thickness.";
    static constexpr FieldList fields{
        Setting{"id", &MarkerSpec::id, "", "the tag's number", {.required = true, .max = last_tag}},
        Setting{"name",
                &MarkerSpec::name,
                "",
                "for teleport; letters, digits and _",
                {.fallback = "\"marker_ID\"", .adopt = adopt_identifier}},
        Setting{"size",
                &MarkerSpec::size,
                "m",
                "edge of the black border",
                {.range = NumberRange::positive, .least = least_length}},
        Setting{"at", &MarkerSpec::at, "m", "centre", {.required = true}},
        Setting{"facing", &MarkerSpec::facing, "rad", "yaw of the direction that it faces"},
        Internal{&MarkerSpec::place},
    };
};

template <>
struct Describe<FloorSpec> {
    static constexpr std::string_view name = "floor";
    static constexpr std::string_view doc = "A picture on the floor, its middle at the origin.";
    static constexpr FieldList fields{
        Setting{"image",
                &FloorSpec::image,
                "",
                "a picture (PNG, JPEG, BMP, TIFF, PPM, WebP ...); its upper edge lies towards positive y, its right "
                "one towards positive x",
                {.required = true}},
        Setting{"size",
                &FloorSpec::size,
                "m",
                "of the whole picture along x and y",
                {.required = true, .range = NumberRange::positive}},
        Internal{&FloorSpec::place},
    };
};

template <>
struct Describe<LineSpec> {
    static constexpr std::string_view name = "line";
    static constexpr std::string_view doc = "A line painted on the floor; needs the arena's `size`, or a `floor`.";
    static constexpr FieldList fields{
        Extra{"points",
              "number[][]",
              "m",
              "`{ { x, y }, ... }`, two or more; a line whose last point is its first is closed",
              {.by_hand = true, .fallback = "required"}},
        Setting{"width", &LineSpec::width, "m", "", {.range = NumberRange::positive, .least = least_line}},
        Setting{"color", &LineSpec::color, "", "as of a box", {.fallback = "\"black\"", .adopt = adopt_color}},
        Internal{&LineSpec::points},
        Internal{&LineSpec::place},
    };
};

template <>
struct Describe<MazePlan> {
    static constexpr std::string_view name = "maze_plan";
    static constexpr std::string_view doc = "A generated maze: there is exactly one path between any two cells.";
    static constexpr FieldList fields{
        Setting{"columns", &MazePlan::columns, "", "cells from west to east", {.min = 1, .max = most_maze_cells}},
        Setting{"rows", &MazePlan::rows, "", "cells from south to north", {.min = 1, .max = most_maze_cells}},
        Setting{"seed", &MazePlan::seed, "", "another seed, another maze", {.max = 1'000'000}},
    };
};

template <>
struct Describe<MazeSpec> {
    static constexpr std::string_view name = "maze";
    static constexpr std::string_view doc = "The walls of a maze of square cells, as in the contests of micromice.";
    static constexpr FieldList fields{
        Extra{"rows", "string[]", "", "the maze as a drawing, the north first", {.by_hand = true}},
        Setting{"generate", &MazeSpec::generate, "", "instead of `rows`: generates a maze"},
        Setting{"cell",
                &MazeSpec::cell,
                "m",
                "distance of two walls, from middle to middle; 0.09 in half-size contests",
                {.range = NumberRange::positive}},
        Setting{"thickness",
                &MazeSpec::thickness,
                "m",
                "of walls and posts; 0.006 in half-size contests",
                {.range = NumberRange::positive, .least = least_length}},
        Setting{"at", &MazeSpec::at, "m", "centre of the south-west cell"},
        Internal{&MazeSpec::place},
    };
};

template <>
struct Describe<BorderSpec> {
    static constexpr std::string_view name = "border";
    static constexpr std::string_view doc = "The walls around an arena.";
    static constexpr FieldList fields{
        Setting{"thickness", &BorderSpec::thickness, "m", "", {.range = NumberRange::positive, .least = least_length}},
        Setting{"height", &BorderSpec::height, "m", "", {.range = NumberRange::positive, .least = least_length}},
    };
};

template <>
struct Describe<ArenaSpec> {
    static constexpr std::string_view name = "arena";
    static constexpr std::string_view doc = "The floor and what stands on it. Several arenas add up.";
    static constexpr FieldList fields{
        Setting{"size",
                &ArenaSpec::size,
                "m",
                "inner length and width, the middle at the origin; without: unbounded",
                {.range = NumberRange::positive}},
        Setting{"border", &ArenaSpec::border, "", "walls around `size`", {.fallback = "true"}},
        Internal{&ArenaSpec::boxes},
        Internal{&ArenaSpec::cylinders},
        Internal{&ArenaSpec::markers},
        Internal{&ArenaSpec::floor},
        Internal{&ArenaSpec::lines},
    };
};

}  // namespace nezumi
