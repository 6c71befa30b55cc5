// The description of an arena: the objects at the start of a system.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/ports/messages.hpp"

namespace nezumi {

/// A box, fixed or movable. Walls and the rows of a CSV map are boxes as well.
struct BoxSpec {
    Point3D at{};      ///< [m] centre
    Point3D size{};    ///< [m] along its own x, y, z; all positive
    double yaw = 0;    ///< [rad]
    double mass = 0;   ///< [kg]; 0: it never moves
    double pitch = 0;  ///< [rad] before the yaw; positive: the front is lower, which makes a ramp
    std::string color = "#8a8f98";
    Place place;
};

/// An upright cylinder.
struct CylinderSpec {
    Point3D at{};       ///< [m] centre
    double radius = 0;  ///< [m]
    double height = 0;  ///< [m]
    double mass = 0;    ///< [kg]; 0: it never moves
    std::string color = "#8a8f98";
    Place place;
};

/// A square fiducial marker (AprilTag 36h11) without thickness.
struct MarkerSpec {
    std::string name;
    int id = 0;
    double size = 0.1;  ///< [m] edge of the black border
    Point3D at{};       ///< [m] centre
    double facing = 0;  ///< [rad] yaw of its outward normal
    Place place;
};

/// A picture on the floor, centred on the origin.
struct FloorSpec {
    std::string image;  ///< resolved path
    Point2D size{};     ///< [m]
    Place place;
};

/// A line painted on the floor, from point to point, with round ends and corners.
struct LineSpec {
    std::vector<Point2D> points;  ///< [m] two or more
    double width = 0.02;          ///< [m]
    std::string color = "#1c1c1c";
    Place place;
};

/// The walls around an arena.
struct BorderSpec {
    double thickness = 0.02;  ///< [m]
    double height = 0.1;      ///< [m]
    bool operator==(const BorderSpec&) const = default;
};

struct ArenaSpec {
    std::optional<Point2D> size;  ///< [m] inner length and width, centred on the origin; none: unbounded
    std::optional<BorderSpec> border = BorderSpec{};  ///< walls around `size`
    std::vector<BoxSpec> boxes;
    std::vector<CylinderSpec> cylinders;
    std::vector<MarkerSpec> markers;
    std::optional<FloorSpec> floor;
    std::vector<LineSpec> lines;  ///< over the floor's picture; without one, over all of `size`
};

/// The name of the box or cylinder with this index in its list: "box 1", "cylinder 2".
std::string thing_name(std::string_view shape, std::size_t index);

/// Moves a box or cylinder; its height and pitch do not change. Does nothing if there is none with this name.
void move_thing(ArenaSpec& arena, std::string_view name, const Pose2D& pose);

}  // namespace nezumi
