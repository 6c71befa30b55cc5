// Occupancy maps of ROS: a picture of the occupied places, and a YAML file with the picture's scale and origin.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "engine/world/arena_spec.hpp"
#include "engine/world/picture.hpp"

namespace nezumi {

/// The content of the YAML file; its keys have the meaning of ROS's map_server.
struct OccupancyFacts {
    enum class Mode {
        trinary,  ///< pixels darker than the threshold are occupied
        scale,    ///< as `trinary`; pixels between the two thresholds of the file are not occupied
        raw,      ///< a pixel's value, 0 to 100, is its occupancy in percent; larger values are unknown
    };

    std::string image;        ///< the file of the picture, beside the YAML file
    Place image_place;        ///< where the YAML file names it
    double resolution = 0;    ///< [m] edge of a pixel
    Pose2D origin;            ///< of the lower left corner of the picture
    bool negate = false;      ///< true: white is occupied
    double threshold = 0.65;  ///< pixels with a larger part of black are occupied (`occupied_thresh`)
    Mode mode = Mode::trinary;
};

struct OccupancyMap {
    std::vector<BoxSpec> boxes;  ///< occupied pixels, joined to rectangles
    int columns = 0, rows = 0;   ///< of the picture
    std::size_t occupied = 0;    ///< number of pixels
};

inline constexpr double occupancy_height = 0.1;  ///< [m] default height of the boxes, because a map does not contain it

/// Reads the YAML file and ignores other keys. Errors have `file` and the line.
Expected<OccupancyFacts> read_occupancy_facts(std::string_view text, const std::string& file);

/// Reads `picture`, the content of a file in any format of OpenCV. Errors have `file`. The boxes get `height` [m] and
/// `place`.
Expected<OccupancyMap> read_occupancy(const OccupancyFacts& facts, std::string_view picture, const std::string& file,
                                      double height, const Place& place);

/// "map.yaml: 12 boxes from 640 occupied pixels of 384 x 384".
std::string describe(const OccupancyMap& map, const std::string& file);

}  // namespace nezumi
