// The few lines of YAML that a map has, its picture, and the rectangles that cover what is occupied.
#include "engine/world/occupancy_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include "engine/base/trimmed.hpp"
#include "engine/ports/setting.hpp"
#include "engine/world/frames.hpp"

namespace nezumi {
namespace {

constexpr std::int64_t most_pixels = 64'000'000;
constexpr double least_resolution = 1e-3, most_resolution = 1e3;  // [m]

std::string_view without_quotes(std::string_view text) {
    const bool quoted =
        text.size() >= 2 && (text.front() == '"' || text.front() == '\'') && text.front() == text.back();
    return quoted ? text.substr(1, text.size() - 2) : text;
}

std::optional<double> number_of(std::string_view text) {
    text = trimmed(text);
    if (text.starts_with('+')) text.remove_prefix(1);
    double number = 0;
    const auto [stopped, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (problem != std::errc() || stopped != text.data() + text.size() || !std::isfinite(number)) return std::nullopt;
    return number;
}

// `[x, y, yaw]`, or the first two of them.
std::optional<Pose2D> pose_of(std::string_view text) {
    if (!text.starts_with('[') || !text.ends_with(']')) return std::nullopt;
    text = text.substr(1, text.size() - 2);
    std::array<double, 3> numbers{};
    std::size_t count = 0;
    while (count < numbers.size()) {
        const std::size_t comma = std::min(text.find(','), text.size());
        const auto number = number_of(text.substr(0, comma));
        if (!number) return std::nullopt;
        numbers[count++] = *number;
        if (comma == text.size())
            return count < 2 ? std::nullopt : std::optional(Pose2D{{numbers[0], numbers[1]}, numbers[2]});
        text.remove_prefix(comma + 1);
    }
    return std::nullopt;
}

// What a line says; empty names for lines that say nothing here.
struct Line {
    std::string_view key, value;
};

Line line_of(std::string_view text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool begins_comment = text[i] == '#' && (i == 0 || text[i - 1] == ' ' || text[i - 1] == '\t');
        if (begins_comment) text = text.substr(0, i);
    }
    const std::size_t colon = text.find(':');
    if (colon == std::string_view::npos) return {};
    return {trimmed(text.substr(0, colon)), without_quotes(trimmed(text.substr(colon + 1)))};
}

// A portable grey map: its pixels row by row from the top, and what is white.
struct Grey {
    int columns = 0, rows = 0, white = 255;
    std::span<const unsigned char> pixels;
};

Expected<Grey> read_grey(std::string_view bytes, const std::string& file) {
    const auto refuse = [&](std::string_view why) { return failure(fmt::format("is no map: {}", why), {file}); };
    if (!bytes.starts_with("P5")) return refuse("expected a binary PGM, which begins with P5");
    std::size_t at = 2;
    const auto is_blank = [&] {
        return at < bytes.size() && std::string_view(" \t\r\n").find(bytes[at]) != std::string_view::npos;
    };
    const auto next = [&]() -> std::int64_t {
        while (is_blank() || (at < bytes.size() && bytes[at] == '#')) {
            if (bytes[at] == '#') {
                at = std::min(bytes.find('\n', at), bytes.size());
            } else {
                ++at;
            }
        }
        std::int64_t number = -1;
        const auto [stopped, problem] = std::from_chars(bytes.data() + at, bytes.data() + bytes.size(), number);
        if (problem != std::errc()) return -1;
        at = static_cast<std::size_t>(stopped - bytes.data());
        return number;
    };
    const std::int64_t columns = next(), rows = next(), white = next();
    if (columns < 1 || rows < 1 || white < 1 || !is_blank()) return refuse("its header has no width, height and white");
    if (white > 255) return refuse(fmt::format("expected pixels of 8 bits, its white is {}", white));
    if (columns > most_pixels / rows)
        return refuse(
            fmt::format("it has {} x {} pixels, expected at most {} million", columns, rows, most_pixels / 1'000'000));
    const std::string_view data = bytes.substr(at + 1);
    const auto count = static_cast<std::size_t>(columns * rows);
    if (data.size() < count) return refuse(fmt::format("it ends after {} of {} pixels", data.size(), count));
    return Grey{static_cast<int>(columns),
                static_cast<int>(rows),
                static_cast<int>(white),
                {reinterpret_cast<const unsigned char*>(data.data()), count}};
}

// A rectangle of pixels; row 0 is at the top.
struct Rectangle {
    int column, row, columns, rows;
};

// Covers all that is marked, each pixel once: from each first pixel as far to the right, then as far down as it goes.
std::vector<Rectangle> cover(std::vector<bool> marked, int columns, int rows) {
    const auto index = [&](int column, int row) {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
    };
    std::vector<Rectangle> all;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            if (!marked[index(column, row)]) continue;
            Rectangle found{column, row, 1, 1};
            while (column + found.columns < columns && marked[index(column + found.columns, row)]) ++found.columns;
            const auto goes_on = [&](int below) {
                for (int i = 0; i < found.columns; ++i) {
                    if (!marked[index(column + i, below)]) return false;
                }
                return true;
            };
            while (row + found.rows < rows && goes_on(row + found.rows)) ++found.rows;
            for (int r = row; r < row + found.rows; ++r) {
                for (int c = column; c < column + found.columns; ++c) marked[index(c, r)] = false;
            }
            all.push_back(found);
        }
    }
    return all;
}

}  // namespace

Expected<OccupancyFacts> read_occupancy_facts(std::string_view text, const std::string& file) {
    OccupancyFacts facts;
    bool has_origin = false;
    for (int number = 1; !text.empty(); ++number) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const auto [key, value] = line_of(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        const auto refuse = [&, key = key, value = value](std::string_view expected) {
            return failure(fmt::format("'{}': expected {}, got '{}'", key, expected, shown(value)), {file, number});
        };
        const auto real = number_of(value);
        if (key == "image") {
            facts.image = value;
        } else if (key == "resolution") {
            if (!real || *real < least_resolution || *real > most_resolution)
                return refuse(
                    fmt::format("the edge of a pixel in m, from {} to {}", least_resolution, most_resolution));
            facts.resolution = *real;
        } else if (key == "origin") {
            const auto pose = pose_of(value);
            if (!pose) return refuse("[x, y, yaw]");
            if (!check_pose(*pose).empty()) return refuse(fmt::format("numbers up to {}", Rule{}.most));
            facts.origin = *pose;
            has_origin = true;
        } else if (key == "negate") {
            if (value != "0" && value != "1" && value != "false" && value != "true") return refuse("0 or 1");
            facts.negate = value == "1" || value == "true";
        } else if (key == "mode") {
            // The others tell more of a pixel than whether something stands there.
            if (value != "trinary") return refuse("trinary, the only mode that is read");
        } else if (key == "occupied_thresh") {
            if (!real || *real < 0 || *real > 1) return refuse("a number from 0 to 1");
            facts.threshold = *real;
        }
    }
    const std::string_view missing = facts.image.empty() ? "image" : facts.resolution == 0 ? "resolution" : "origin";
    if (facts.image.empty() || facts.resolution == 0 || !has_origin)
        return failure(fmt::format("is no map of ROS: it has no '{}:'", missing), {file});
    return facts;
}

Expected<OccupancyMap> read_occupancy(const OccupancyFacts& facts, std::string_view picture, const std::string& file,
                                      const Place& place) {
    const auto grey = read_grey(picture, file);
    if (!grey) return Unexpected(grey.error());
    OccupancyMap map;
    map.columns = grey->columns;
    map.rows = grey->rows;
    std::vector<bool> occupied;
    occupied.reserve(grey->pixels.size());
    for (const unsigned char pixel : grey->pixels) {
        const double light = std::min(1.0, static_cast<double>(pixel) / grey->white);
        occupied.push_back((facts.negate ? light : 1 - light) > facts.threshold);
    }
    map.occupied = static_cast<std::size_t>(std::count(occupied.begin(), occupied.end(), true));
    const double edge = facts.resolution;
    for (const Rectangle& found : cover(std::move(occupied), map.columns, map.rows)) {
        const Point2D in_picture{(found.column + found.columns / 2.0) * edge,
                                 (map.rows - found.row - found.rows / 2.0) * edge};
        const Point2D at = placed_at(facts.origin, {in_picture, 0}).position;
        BoxSpec box;
        box.at = {at.x, at.y, occupancy_height / 2};
        box.size = {found.columns * edge, found.rows * edge, occupancy_height};
        box.yaw = facts.origin.heading;
        box.place = place;
        map.boxes.push_back(std::move(box));
    }
    return map;
}

std::string describe(const OccupancyMap& map, const std::string& file) {
    return fmt::format("{}: {} box{} from {} of {} x {} pixels", file, map.boxes.size(),
                       map.boxes.size() == 1 ? "" : "es", map.occupied, map.columns, map.rows);
}

}  // namespace nezumi
