// Builds a world and answers queries between steps.
#include "sim/ode_world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/list.hpp"
#include "sim/markers.hpp"
#include "sim/robot_body.hpp"

#include "engine/ports/payload.hpp"
#include "engine/ports/setting.hpp"
#include "engine/world/frames.hpp"

namespace nezumi::sim {
namespace {

constexpr double least_overlap = 1e-6;  // [m] touching is not overlapping
constexpr const char* border_color = "#5c6470";

}  // namespace

OdeWorld::OdeWorld(const ArenaSpec& arena, const PhysicsSpec& physics, std::function<void(const std::string&)> warn)
    : step_(physics.step),
      seed_(physics.seed),
      inside_(arena.border ? arena.size : std::nullopt),
      random_(static_cast<unsigned long>((physics.seed ^ (physics.seed >> 32)) & 0xffffffffu)),
      warn_([this, warn = std::move(warn)](const std::string& text) {
          // ODE's message contains the size of the error, which differs each time; so only the text before it is
          // compared.
          if (warn && warned_.insert(text.substr(0, text.find(" (s="))).second) warn(text);
      }),
      world_(dWorldCreate()),
      ahead_(movers_, scene_, step_),
      contacts_(world_.get(), step_, scene_, movers_, islands_) {
    // By default the whole process shares one set of job lists; worlds on two threads would corrupt it.
    threading_ = ThreadingHandle(dThreadingAllocateSelfThreadedImplementation());
    dWorldSetStepThreadingImplementation(world_.get(), dThreadingImplementationGetFunctions(threading_.get()),
                                         threading_.get());
    dWorldSetGravity(world_.get(), 0, 0, -gravity);
    dWorldSetContactMaxCorrectingVel(world_.get(), correcting_speed);
    dWorldSetQuickStepNumIterations(world_.get(), 20);
    add_border(arena);
    for (std::size_t i = 0; i < arena.boxes.size(); ++i) add_box(arena.boxes[i], thing_name("box", i));
    for (std::size_t i = 0; i < arena.cylinders.size(); ++i)
        add_cylinder(arena.cylinders[i], thing_name("cylinder", i));
    for (const MarkerSpec& marker : arena.markers) {
        markers_.push_back(pose_of(marker));
    }
    scene_.refresh();
}

OdeWorld::~OdeWorld() {
    if (!breakdown_) return;
    contacts_.keep();
    OdeLibrary::keep(world_.release());
    OdeLibrary::keep(threading_.release());
}

void OdeWorld::add_border(const ArenaSpec& arena) {
    if (!arena.size || !arena.border) return;
    const double x = arena.size->x, y = arena.size->y, t = arena.border->thickness, h = arena.border->height;
    for (const double side : {1.0, -1.0}) {
        add_box({.at = {side * (x + t) / 2, 0, h / 2}, .size = {t, y + 2 * t, h}, .color = border_color}, "wall");
        add_box({.at = {0, side * (y + t) / 2, h / 2}, .size = {x, t, h}, .color = border_color}, "wall");
    }
}

void OdeWorld::add_box(const BoxSpec& box, std::string name) {
    add_shape({Shape::Kind::box, to_vec(box.at), yaw_pitch_rotation(box.yaw, box.pitch), to_vec(box.size) * 0.5},
              box.mass, {std::move(name), box.color, box.place});
}

void OdeWorld::add_cylinder(const CylinderSpec& cylinder, std::string name) {
    add_shape({Shape::Kind::cylinder,
               to_vec(cylinder.at),
               Rotation::Identity(),
               {cylinder.radius, cylinder.radius, cylinder.height / 2}},
              cylinder.mass, {std::move(name), cylinder.color, cylinder.place});
}

void OdeWorld::add_shape(const Shape& shape, double mass, Label label) {
    if (mass <= 0) {
        scene_.add_fixed(shape);
        fixed_labels_.push_back(std::move(label));
        return;
    }
    const dBodyID body = dBodyCreate(world_.get());
    const dMass m = mass_of(shape, mass);
    dBodySetMass(body, &m);
    BodyView(body).put(shape.centre, shape.rotation);
    // Otherwise a cylinder on its side would never stop rolling.
    dBodySetAngularDamping(body, 0.01);
    islands_.add_mover();
    movers_.things.emplace_back(body, scene_.add_mover(shape), mass);
    thing_labels_.push_back(std::move(label));
}

Expected<void> OdeWorld::check_things() {
    for (std::size_t i = movers_.things.size();
         i-- > 0;) {  // the last first, because it is the one that was placed wrongly
        const Thing& thing = movers_.things[i];
        const Shape& shape = scene_.movers()[thing.mover];
        const auto overlap = find_overlap(shape, shape.reach(), thing.mover, least_overlap_of_things);
        if (!overlap) continue;
        return failure(
            fmt::format("{} at x = {:g}, y = {:g} overlaps {} by {:.0f} mm: move one of them", thing_labels_[i].name,
                        shape.centre.x(), shape.centre.y(), overlap->other, overlap->depth * 1e3),
            thing_labels_[i].place);
    }
    return {};
}

std::optional<OdeWorld::Overlap> OdeWorld::find_overlap(const Shape& shape, double reach, Scene::Index self,
                                                        double least, bool looks_at_fixed) {
    const double x = shape.centre.x(), y = shape.centre.y();
    std::optional<Overlap> found;
    const auto look = [&](const Obstacle& obstacle, const Shape& other) {
        if (found) return;
        for (const Touch& touch : narrow_.collide(shape, other)) {
            if (touch.depth > (found ? found->depth : least)) found = Overlap{name_of(obstacle), touch.depth};
        }
        if (!found) return;
        if (!obstacle.moves && found->other == "wall") found->other = "the arena's wall";
        if (obstacle.moves && !movers_.is_thing(obstacle.index)) found->other = "robot '" + found->other + "'";
    };
    scene_.for_each_mover_near(x, y, reach, self, [&](Scene::Index i, const Shape& other) { look({true, i}, other); });
    if (!looks_at_fixed) return found;
    scene_.for_each_fixed_near(x, y, reach, [&](Scene::Index i, const Shape& other) {
        if (distance_from_above(other, x, y) <= reach) look({false, i}, other);
    });
    return found;
}

RobotModel& OdeWorld::model_of(const RobotSpec& spec) {
    std::unique_ptr<RobotModel>& model = models_[&spec];
    if (model == nullptr) model = std::make_unique<RobotModel>(spec, step_);
    return *model;
}

Expected<std::unique_ptr<RobotBody>> OdeWorld::add_robot(const std::string& name, const RobotSpec& spec, Pose2D pose) {
    RobotModel& model = model_of(spec);
    if (auto free = check_free(model, name, pose, Scene::nobody); !free) return Unexpected(free.error());

    const dBodyID body = dBodyCreate(world_.get());
    const dMass m = mass_of(model.hull, model.mass);
    dBodySetMass(body, &m);
    dBodySetGyroscopicMode(body, 0);  // not needed, since wheels hold the robot upright; saves time
    const BodyView view(body);
    view.put(rest_centre(model, pose, Scene::nobody), yaw_rotation(pose.heading));
    Shape hull = model.hull;
    place_hull(hull, model, view);
    islands_.add_mover();
    neighbours_.expire();
    movers_.robots.emplace_back(body, model, scene_.add_mover(hull, model.reach), name);
    signals_.emplace_back();
    warn_of_high_rays(name, spec);
    return std::make_unique<SimRobotBody>(*this, movers_.robots.size() - 1, spec, mix(seed_, std::string_view(name)));
}

// A ray that hits nothing is not an error. But if all walls and boxes end below it, the description probably has a
// wrong height.
void OdeWorld::warn_of_high_rays(const std::string& name, const RobotSpec& spec) const {
    constexpr double kerb = 0.01;  // [m] lower shapes need not be visible
    double top = 0;
    for (const ThingPose& thing : things()) {
        if (thing.shape == ThingPose::Shape::box) top = std::max(top, thing.pose.position.z + thing.size.z / 2);
    }
    if (top <= kerb) return;
    for (const SensorSpec& sensor : spec.sensors) {
        if (sensor.kind != SensorSpec::Kind::range && sensor.kind != SensorSpec::Kind::scan) continue;
        if (sensor.at.z <= top) continue;
        warn_(
            fmt::format("robot '{}': the rays of '{}' pass over every wall: they start {:g} m over the "
                        "floor, as a sensor's `at` counts from the hull's centre, and the highest wall ends at {:g} m",
                        name, sensor.name, sensor.at.z, top));
        return;
    }
}

void OdeWorld::remove_robot(RobotId id) {
    SimRobot& robot = movers_.robots[id];
    robot.gone = true;
    robot.has_neighbours = false;
    robot.constraint = {};
    robot.speeds = {};
    dBodySetLinearVel(robot.body.id, 0, 0, 0);
    dBodySetAngularVel(robot.body.id, 0, 0, 0);
    dBodyDisable(robot.body.id);
    scene_.remove_mover(robot.mover);
    neighbours_.expire();
    for (Thing& thing : movers_.things) {
        // Things that lay on the robot must fall.
        const auto& near = thing.near.movers;
        if (contains(near, robot.mover)) thing.wake();
    }
}

// The hull's centre for a robot that stands at this pose: on the floor, or on the highest shape below its wheels and
// skids.
Vec3 OdeWorld::rest_centre(const RobotModel& model, const Pose2D& pose, Scene::Index self) const {
    const Rotation rotation = yaw_rotation(pose.heading);
    const Vec3 centre = Vec3{pose.position.x, pose.position.y, 0} - rotate(rotation, model.origin);
    double height = 0;
    const double from_height = centre.z() + model.hull_drop - model.hull.half.z();
    for (const Vec3& point : {model.wheels[0], model.wheels[1], model.skids[0], model.skids[1]}) {
        Vec3 from = centre + rotate(rotation, point);
        from.z() = from_height;
        const double distance = cast_ray(scene_, from, {0, 0, -1}, from_height, self);
        if (distance < nothing && distance > 0) height = std::max(height, from_height - distance);
    }
    return centre + Vec3{0, 0, height};
}

Expected<void> OdeWorld::check_inside(const std::string& what, const Point2D& at) const {
    if (!inside_ || (std::abs(at.x) <= inside_->x / 2 && std::abs(at.y) <= inside_->y / 2)) return {};
    return failure(
        fmt::format("{} at x = {:g}, y = {:g} is outside the arena of {:g} x {:g} m: put it inside, or set border = "
                    "false",
                    what, at.x, at.y, inside_->x, inside_->y));
}

Expected<void> OdeWorld::check_free(const RobotModel& model, const std::string& name, const Pose2D& pose,
                                    Scene::Index self) {
    if (const std::string problem = check_pose(pose); !problem.empty())
        return failure(fmt::format("robot '{}': its pose: {}", name, problem));
    if (auto inside = check_inside(fmt::format("robot '{}'", name), pose.position); !inside) return inside;
    Shape hull = model.hull;
    hull.rotation = yaw_rotation(pose.heading);
    hull.centre = rest_centre(model, pose, self) + Vec3{0, 0, model.hull_drop};

    const auto overlap = find_overlap(hull, model.reach, self, least_overlap);
    if (!overlap) return {};
    return failure(fmt::format("robot '{}' at x = {:g}, y = {:g} overlaps {}: move one of them", name, pose.position.x,
                               pose.position.y, overlap->other));
}

std::optional<double> OdeWorld::clearance(RobotId id, double most) const {
    const SimRobot& self = robot(id);
    if (self.touched || most <= 0) return 0;
    Shape hull = self.model->hull;
    place_hull(hull, *self.model, self.body);
    const double top = hull.centre.z() + hull.half_height();
    const double reach = hull.reach();
    // A small tilt is ignored.
    const auto level = [](Shape& shape) {
        if (shape.rotation(2, 2) > 0.9)
            shape.rotation = yaw_rotation(std::atan2(shape.rotation(1, 0), shape.rotation(0, 0)));
    };
    level(hull);
    double least = most;
    const auto look = [&](const Shape& shape) {
        if (shape.centre.z() - shape.half_height() > top) return;
        // Skips the exact computation for shapes that can't be nearer than the nearest one so far.
        const double dx = shape.centre.x() - hull.centre.x(), dy = shape.centre.y() - hull.centre.y();
        const double far = least + reach + shape.reach();
        if (dx * dx + dy * dy >= far * far) return;
        if (distance_from_above(shape, hull.centre.x(), hull.centre.y()) - reach >= least) return;
        least = std::min(least, gap_from_above(hull, shape));
    };
    // Searches a small range first, which is fast. If an object is found there, no larger search is needed.
    for (const double range : {0.1 * most, most}) {
        scene_.for_each_fixed_near(hull.centre.x(), hull.centre.y(), reach + range,
                                   [&](Scene::Index, const Shape& shape) { look(shape); });
        scene_.for_each_mover_near(hull.centre.x(), hull.centre.y(), reach + range, self.mover,
                                   [&](Scene::Index index, Shape shape) {
                                       if (!movers_.is_thing(index)) level(shape);
                                       look(shape);
                                   });
        if (least <= range) break;
    }
    return least;
}

Truth OdeWorld::truth(RobotId id) const {
    const SimRobot& robot = movers_.robots[id];
    const Rotation rotation = robot.body.rotation();
    const Vec3 to_origin = rotate(rotation, robot.model->origin);
    const Vec3 origin = robot.body.centre() + to_origin, velocity = robot.body.velocity_at(to_origin);
    const double heading = std::atan2(rotation(1, 0), rotation(0, 0));
    // Uses the frame at the beginning of the step. In the frame at its end, a turning robot would seem to skid.
    const Point2D speed = turned({velocity.x(), velocity.y()}, robot.body.w[2] * step_ - heading);
    Truth truth;
    truth.pose = {{origin.x(), origin.y()}, heading};
    truth.velocity = {.vx = speed.x, .vy = speed.y, .va = robot.body.w[2]};
    truth.height = origin.z();
    truth.tilt = std::acos(std::clamp(rotation(2, 2), -1.0, 1.0));
    return truth;
}

Expected<void> OdeWorld::teleport(RobotId id, Pose2D pose) {
    SimRobot& robot = movers_.robots[id];
    if (auto free = check_free(*robot.model, robot.name, pose, robot.mover); !free) return free;
    robot.body.put(rest_centre(*robot.model, pose, robot.mover), yaw_rotation(pose.heading));
    place_movers();
    scene_.refresh();
    neighbours_.expire();
    return {};
}

void OdeWorld::disturb(RobotId id, const VelocityConstraint& constraint) {
    SimRobot& robot = this->robot(id);
    robot.constraint = {};  // removes the old joints before new ones are made: ODE orders joints by creation
    robot.constraint = ConstraintMotors(world_.get(), robot, constraint);
}

std::vector<Point3D> OdeWorld::contact_points(RobotId id) const {
    std::vector<Point3D> points;
    for (const Vec3& point : robot(id).contact_points) points.push_back(to_point(point));
    return points;
}

std::string OdeWorld::name_of(const Obstacle& obstacle) const {
    if (!obstacle.moves) return fixed_labels_[obstacle.index].name;
    if (movers_.is_thing(obstacle.index)) return thing_labels_[obstacle.index].name;
    return movers_.robots[obstacle.index - movers_.things.size()].name;
}

}  // namespace nezumi::sim
