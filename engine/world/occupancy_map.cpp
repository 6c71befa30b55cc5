// Reads a map's YAML file and picture, and covers the occupied pixels with rectangles.
#include "engine/world/occupancy_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>

#include "engine/base/yaml.hpp"
#include "engine/ports/setting.hpp"
#include "engine/world/frames.hpp"

namespace nezumi {
namespace {

constexpr double least_resolution = 1e-3, most_resolution = 1e3;  // [m]
constexpr std::array<std::string_view, 3> modes{"trinary", "scale", "raw"};

// `[x, y, yaw]`, or the first two of them.
std::optional<Pose2D> pose_of(const YAML::Node& value) {
    const auto numbers = yaml_numbers(value);
    if (!numbers || numbers->size() < 2 || numbers->size() > 3) return std::nullopt;
    return Pose2D{{(*numbers)[0], (*numbers)[1]}, numbers->size() == 3 ? (*numbers)[2] : 0};
}

// The value of white in a picture: for a portable grey map, whose bytes OpenCV does not scale, its largest value;
// otherwise 255.
double white_of(std::string_view bytes) {
    constexpr double usual = 255, usual_of_two_bytes = 65535;
    if (!bytes.starts_with("P5")) return usual;
    std::istringstream in(std::string(bytes.substr(0, 4096)));
    std::string word;
    for (int words = 0; in >> word;) {  // P5, columns, rows, white, and comments between them
        if (word.starts_with('#')) {
            std::getline(in, word);
        } else if (++words == 4) {
            const double white = std::atof(word.c_str());
            return white > usual ? white / usual_of_two_bytes * usual : white > 0 ? white : usual;
        }
    }
    return usual;
}

// The brightness of each pixel, from 0 (black) to 1 (white).
std::vector<double> light_of(const Picture& picture, double white) {
    constexpr int channels = 3;
    std::vector<double> light;
    light.reserve(picture.pixels.size());
    for (const Rgb pixel : picture.pixels) {
        const auto sum = (pixel >> 16 & 0xff) + (pixel >> 8 & 0xff) + (pixel & 0xff);
        light.push_back(std::min(1.0, sum / (channels * white)));
    }
    return light;
}

bool is_occupied(const OccupancyFacts& facts, double light) {
    if (facts.mode != OccupancyFacts::Mode::raw) return (facts.negate ? light : 1 - light) > facts.threshold;
    constexpr double white = 255, certain = 100;
    const double percent = std::round(light * white);
    return percent <= certain && percent / certain > facts.threshold;
}

// A rectangle of pixels; row 0 is at the top.
struct Rectangle {
    int column, row, columns, rows;
};

// Covers all marked pixels with rectangles that do not overlap: each starts at the first uncovered pixel, is extended
// to the right as far as possible, then downwards.
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
    const auto yaml = read_yaml(text, file);
    if (!yaml) return Unexpected(yaml.error());
    OccupancyFacts facts;
    const auto refuse = [&](const char* key, std::string_view expected) {
        const YAML::Node value = yaml_field(*yaml, key);
        return failure(fmt::format("'{}': expected {}, got '{}'", key, expected, shown(yaml_text(value))),
                       yaml_place(value, file));
    };
    if (const YAML::Node image = yaml_field(*yaml, "image"); image.IsDefined()) {
        facts.image = image.IsScalar() ? image.Scalar() : "";
        if (facts.image.empty()) return refuse("image", "the name of a picture's file");
        facts.image_place = yaml_place(image, file);
    }
    if (const YAML::Node value = yaml_field(*yaml, "resolution"); value.IsDefined()) {
        const auto resolution = yaml_number(value);
        if (!resolution || *resolution < least_resolution || *resolution > most_resolution)
            return refuse("resolution",
                          fmt::format("the edge of a pixel in m, from {} to {}", least_resolution, most_resolution));
        facts.resolution = *resolution;
    }
    if (const YAML::Node value = yaml_field(*yaml, "origin"); value.IsDefined()) {
        const auto origin = pose_of(value);
        if (!origin) return refuse("origin", "[x, y, yaw]");
        if (!check_pose(*origin).empty()) return refuse("origin", fmt::format("numbers up to {}", Rule{}.most));
        facts.origin = *origin;
    }
    if (const YAML::Node negate = yaml_field(*yaml, "negate"); negate.IsDefined()) {
        const auto truth = yaml_boolean(negate);
        if (!truth) return refuse("negate", "0 or 1");
        facts.negate = *truth;
    }
    if (const YAML::Node mode = yaml_field(*yaml, "mode"); mode.IsDefined()) {
        const auto* const found = std::find(modes.begin(), modes.end(), yaml_text(mode));
        if (found == modes.end()) return refuse("mode", "trinary, scale or raw");
        facts.mode = static_cast<OccupancyFacts::Mode>(found - modes.begin());
    }
    if (const YAML::Node value = yaml_field(*yaml, "occupied_thresh"); value.IsDefined()) {
        const auto threshold = yaml_number(value);
        if (!threshold || *threshold < 0 || *threshold > 1) return refuse("occupied_thresh", "a number from 0 to 1");
        facts.threshold = *threshold;
    }
    for (const char* key : {"image", "resolution", "origin"}) {
        if (!yaml_field(*yaml, key).IsDefined())
            return failure(fmt::format("is not a map of ROS: it has no '{}:'", key), {file});
    }
    return facts;
}

Expected<OccupancyMap> read_occupancy(const OccupancyFacts& facts, std::string_view picture, const std::string& file,
                                      double height, const Place& place) {
    const auto decoded = decode_picture(picture);
    if (!decoded) return failure(fmt::format("is not a map: {}", decoded.error().message), {file});
    OccupancyMap map;
    map.columns = decoded->width;
    map.rows = decoded->height;
    std::vector<bool> occupied;
    occupied.reserve(decoded->pixels.size());
    for (const double light : light_of(*decoded, white_of(picture))) occupied.push_back(is_occupied(facts, light));
    map.occupied = static_cast<std::size_t>(std::count(occupied.begin(), occupied.end(), true));
    const double edge = facts.resolution;
    for (const Rectangle& found : cover(std::move(occupied), map.columns, map.rows)) {
        const Point2D in_picture{(found.column + found.columns / 2.0) * edge,
                                 (map.rows - found.row - found.rows / 2.0) * edge};
        const Point2D at = placed_at(facts.origin, {in_picture, 0}).position;
        BoxSpec box;
        box.at = {at.x, at.y, height / 2};
        box.size = {found.columns * edge, found.rows * edge, height};
        box.yaw = facts.origin.heading;
        box.place = place;
        map.boxes.push_back(std::move(box));
    }
    return map;
}

std::string describe(const OccupancyMap& map, const std::string& file) {
    return fmt::format("{}: {} box{} from {} occupied pixels of {} x {}", file, map.boxes.size(),
                       map.boxes.size() == 1 ? "" : "es", map.occupied, map.columns, map.rows);
}

}  // namespace nezumi
