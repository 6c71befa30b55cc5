// Maps as ROS writes them: a picture of what is occupied, and a YAML file that says where it lies.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "engine/world/arena_spec.hpp"
#include "engine/world/picture.hpp"

namespace nezumi {

/// What the YAML file says; the meaning of its keys is that of ROS's map_server.
struct OccupancyFacts {
    enum class Mode {
        trinary,  ///< darker than the threshold is occupied
        scale,    ///< the same: what lies between the thresholds of the file is less than occupied
        raw,      ///< a pixel's value, 0 to 100, is its part of occupied in percent; those above are not known
    };

    std::string image;        ///< the picture's file, beside the YAML file
    Place image_place;        ///< where the file names it
    double resolution = 0;    ///< [m] edge of a pixel
    Pose2D origin;            ///< of the picture's lower left corner
    bool negate = false;      ///< white is occupied
    double threshold = 0.65;  ///< what is darker than this part of black is occupied (`occupied_thresh`)
    Mode mode = Mode::trinary;
};

struct OccupancyMap {
    std::vector<BoxSpec> boxes;  ///< occupied pixels, joined to rectangles
    int columns = 0, rows = 0;   ///< of the picture
    std::size_t occupied = 0;    ///< pixels
};

inline constexpr double occupancy_height = 0.1;  ///< [m] of the boxes, where no other is given: a map does not tell it

/// Reads the YAML file, of which other keys are ignored. `file` is named in errors, which say the line.
Expected<OccupancyFacts> read_occupancy_facts(std::string_view text, const std::string& file);

/// Reads the picture, of any format that OpenCV reads. Errors name its `file`. The boxes have this height [m] and the
/// place of the caller.
Expected<OccupancyMap> read_occupancy(const OccupancyFacts& facts, std::string_view picture, const std::string& file,
                                      double height, const Place& place);

/// "map.yaml: 12 boxes from 640 of 384 x 384 pixels".
std::string describe(const OccupancyMap& map, const std::string& file);

}  // namespace nezumi
