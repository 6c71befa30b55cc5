// Gives the poses of objects in the arena and moves them on request.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "engine/ports/payload.hpp"
#include "engine/ports/setting.hpp"
#include "sim/ode_world.hpp"

namespace nezumi::sim {
namespace {

constexpr std::string_view border_name = "wall";

Pose3D pose_of_frame(const Vec3& centre, const Rotation& r) {
    return {.position = to_point(centre),
            .orientation = {.r = std::atan2(r(2, 1), r(2, 2)),
                            .p = -std::asin(std::clamp(r(2, 0), -1.0, 1.0)),
                            .y = std::atan2(r(1, 0), r(0, 0))}};
}

}  // namespace

Pose3D OdeWorld::pose(RobotId id) const {
    const SimRobot& robot = movers_.robots[id];
    const Rotation rotation = robot.body.rotation();
    return pose_of_frame(robot.body.centre() + rotate(rotation, robot.model->origin), rotation);
}

std::vector<ThingPose> OdeWorld::things() const {
    std::vector<ThingPose> poses;
    const auto add = [&](const Shape& shape, const Label& label) {
        ThingPose pose;
        pose.shape = shape.kind == Shape::Kind::box ? ThingPose::Shape::box : ThingPose::Shape::cylinder;
        pose.size = to_point(shape.half * 2);
        pose.pose = pose_of_frame(shape.centre, shape.rotation);
        pose.color = label.color;
        pose.name = label.name;
        poses.push_back(std::move(pose));
    };
    for (std::size_t i = 0; i < fixed_labels_.size(); ++i) add(scene_.fixed()[i], fixed_labels_[i]);
    for (std::size_t i = 0; i < movers_.things.size(); ++i) add(scene_.movers()[i], thing_labels_[i]);
    return poses;
}

// Moves the shape if the place is free. `self` is its number as a mover, or `Scene::nobody` if it is fixed. A fixed
// shape may overlap other fixed shapes, as the walls of a maze do.
Expected<void> OdeWorld::move_label(const Label& label, Shape& shape, const Pose2D& pose, Scene::Index self) {
    if (auto inside = check_inside(label.name, pose.position); !inside) return inside;
    const double heading = std::atan2(shape.rotation(1, 0), shape.rotation(0, 0));
    Shape moved = shape;
    moved.rotation = yaw_rotation(pose.heading - heading) * shape.rotation;
    moved.centre = {pose.position.x, pose.position.y, shape.centre.z()};
    const auto overlap = find_overlap(moved, moved.reach(), self, least_overlap_of_things, self != Scene::nobody);
    if (overlap) {
        return failure(fmt::format("{} at x = {:g}, y = {:g} overlaps {}: move one of them", label.name,
                                   pose.position.x, pose.position.y, overlap->other));
    }
    shape = moved;
    return {};
}

Expected<void> OdeWorld::move_thing(std::string_view name, const Pose2D& pose) {
    if (const std::string problem = check_pose(pose); !problem.empty())
        return failure(fmt::format("{}: its pose: {}", shown(name), problem));
    if (name == border_name) return failure("the walls of the arena's border can't be moved");
    const auto find = [&](const std::vector<Label>& labels) {
        return std::find_if(labels.begin(), labels.end(), [&](const Label& each) { return each.name == name; });
    };
    const auto fixed = find(fixed_labels_), moving = find(thing_labels_);
    if (fixed != fixed_labels_.end()) {
        const auto index = static_cast<Scene::Index>(fixed - fixed_labels_.begin());
        Shape shape = scene_.fixed()[index];
        if (auto moved = move_label(*fixed, shape, pose, Scene::nobody); !moved) return moved;
        scene_.move_fixed(index, shape);
    } else if (moving != thing_labels_.end()) {
        const Thing& thing = movers_.things[static_cast<std::size_t>(moving - thing_labels_.begin())];
        Shape shape = scene_.movers()[thing.mover];
        if (auto moved = move_label(*moving, shape, pose, thing.mover); !moved) return moved;
        thing.body.put(shape.centre, shape.rotation);
    } else {
        std::vector<std::string_view> names;
        for (const auto* labels : {&fixed_labels_, &thing_labels_}) {
            for (const Label& each : *labels) names.push_back(each.name);
        }
        return failure(fmt::format("there is no thing '{}'{}", shown(name), did_you_mean(name, names)));
    }
    // Things that stood on the moved thing must fall, and things at the new place must notice it.
    for (Thing& thing : movers_.things) thing.wake();
    place_movers();
    scene_.refresh();
    neighbours_.expire();
    return {};
}

}  // namespace nezumi::sim
