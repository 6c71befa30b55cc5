// Building a world, and answering for it between steps.
#include "sim/ode_world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>

namespace nezumi::sim {
namespace {

constexpr double least_overlap = 1e-6;  // [m] to touch is not to overlap
constexpr const char* border_color = "#5c6470";

Vec3 to_vec(const Point3D& p) { return {p.x, p.y, p.z}; }
Point3D to_point(const Vec3& v) { return {v.x, v.y, v.z}; }

dMass mass_of(const Shape& shape, double mass) {
    dMass m;
    if (shape.kind == Shape::Kind::box) {
        dMassSetBoxTotal(&m, mass, 2 * shape.half.x, 2 * shape.half.y, 2 * shape.half.z);
    } else {
        dMassSetCylinderTotal(&m, mass, 3, shape.half.x, 2 * shape.half.z);
    }
    return m;
}

void put_body(dBodyID body, const Vec3& centre, const Rotation& r) {
    const dMatrix3 matrix{r.x.x, r.y.x, r.z.x, 0, r.x.y, r.y.y, r.z.y, 0, r.x.z, r.y.z, r.z.z, 0};
    dBodySetPosition(body, centre.x, centre.y, centre.z);
    dBodySetRotation(body, matrix);
    dBodySetLinearVel(body, 0, 0, 0);
    dBodySetAngularVel(body, 0, 0, 0);
}

}  // namespace

OdeWorld::OdeWorld(const ArenaSpec& arena, const PhysicsSpec& physics, std::function<void(const std::string&)> warn)
    : step_(physics.step),
      random_(static_cast<unsigned long>((physics.seed ^ (physics.seed >> 32)) & 0xffffffffu)),
      warn_([this, warn = std::move(warn)](const std::string& text) {
          // ODE says how much something is off, each time another number.
          if (warn && warned_.insert(text.substr(0, text.find(" (s="))).second) warn(text);
      }) {
    OdeLibrary::use_on_this_thread();
    world_ = WorldHandle(dWorldCreate());
    // The default is one set of job lists for the whole process: worlds on two threads would corrupt each other's.
    threading_ = ThreadingHandle(dThreadingAllocateSelfThreadedImplementation());
    dWorldSetStepThreadingImplementation(world_.get(), dThreadingImplementationGetFunctions(threading_.get()),
                                         threading_.get());
    contacts_ = JointGroupHandle(dJointGroupCreate(0));
    dWorldSetGravity(world_.get(), 0, 0, -gravity);
    // What has got into something else is pushed out gently instead of being shot.
    dWorldSetContactMaxCorrectingVel(world_.get(), 1.0);
    dWorldSetQuickStepNumIterations(world_.get(), 20);
    add_border(arena);
    int number = 0;
    for (const BoxSpec& box : arena.boxes) add_box(box, fmt::format("box {}", ++number));
    number = 0;
    for (const CylinderSpec& cylinder : arena.cylinders) add_cylinder(cylinder, fmt::format("cylinder {}", ++number));
    for (const MarkerSpec& marker : arena.markers) {
        markers_.push_back({.name = marker.name,
                            .id = marker.id,
                            .size = marker.size,
                            .pose = {.position = marker.at, .orientation = {.y = marker.facing}}});
    }
    scene_.refresh();
}

OdeWorld::~OdeWorld() {
    if (!breakdown_) return;
    OdeLibrary::keep(contacts_.release());
    OdeLibrary::keep(world_.release());
    OdeLibrary::keep(threading_.release());
}

void OdeWorld::add_border(const ArenaSpec& arena) {
    if (!arena.size || !arena.border) return;
    const double x = arena.size->x, y = arena.size->y, t = arena.border_thickness, h = arena.border_height;
    for (const double side : {1.0, -1.0}) {
        add_box({.at = {side * (x + t) / 2, 0, h / 2}, .size = {t, y + 2 * t, h}, .color = border_color}, "wall");
        add_box({.at = {0, side * (y + t) / 2, h / 2}, .size = {x, t, h}, .color = border_color}, "wall");
    }
}

void OdeWorld::add_box(const BoxSpec& box, std::string name) {
    add_shape({Shape::Kind::box, to_vec(box.at), Rotation::yaw_pitch(box.yaw, box.pitch), to_vec(box.size) * 0.5},
              box.mass, std::move(name), box.color);
}

void OdeWorld::add_cylinder(const CylinderSpec& cylinder, std::string name) {
    add_shape({Shape::Kind::cylinder, to_vec(cylinder.at), {}, {cylinder.radius, cylinder.radius, cylinder.height / 2}},
              cylinder.mass, std::move(name), cylinder.color);
}

void OdeWorld::add_shape(const Shape& shape, double mass, std::string name, const std::string& color) {
    if (mass <= 0) {
        scene_.add_fixed(shape);
        fixed_looks_.push_back({std::move(name), color});
        return;
    }
    const dBodyID body = dBodyCreate(world_.get());
    const dMass m = mass_of(shape, mass);
    dBodySetMass(body, &m);
    put_body(body, shape.centre, shape.rotation);
    // A cylinder on its side would roll for ever.
    dBodySetAngularDamping(body, 0.01);
    const Scene::Index mover = scene_.add_mover(shape);
    parents_.push_back(mover);
    rows_.push_back(0);
    things_.emplace_back(body, mover, mass);
    thing_looks_.push_back({std::move(name), color});
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
    dBodySetGyroscopicMode(body, 0);  // wheels hold it upright: nothing to gain, and time to lose
    put_body(body, rest_centre(model, pose, Scene::nobody), Rotation::yaw(pose.heading));
    Shape hull = model.hull;
    place_hull(hull, model, BodyView(body));
    const Scene::Index mover = scene_.add_mover(hull, model.reach);
    parents_.push_back(mover);
    rows_.push_back(0);
    may_travel_ = -1;
    robots_.emplace_back(body, model, mover, name);
    return std::make_unique<SimRobotBody>(*this, robots_.size() - 1);
}

void OdeWorld::remove_robot(RobotId id) {
    SimRobot& robot = robots_[id];
    robot.gone = true;
    robot.has_neighbours = false;
    robot.hand = {};
    robot.speeds = {};
    dBodySetLinearVel(robot.body.id, 0, 0, 0);
    dBodySetAngularVel(robot.body.id, 0, 0, 0);
    dBodyDisable(robot.body.id);
    scene_.remove_mover(robot.mover);
    may_travel_ = -1;
    for (Thing& thing : things_) {
        // What lay on it falls.
        const auto& near = thing.near.movers;
        if (std::find(near.begin(), near.end(), robot.mover) != near.end()) wake(thing);
    }
}

// Where the hull's centre is when the robot stands there: on the floor, or on the highest of what its wheels and skids
// would otherwise stick in.
Vec3 OdeWorld::rest_centre(const RobotModel& model, const Pose2D& pose, Scene::Index self) const {
    const Rotation rotation = Rotation::yaw(pose.heading);
    const Vec3 centre = Vec3{pose.position.x, pose.position.y, 0} - rotation * model.origin;
    double height = 0;
    const double from_height = centre.z + model.hull_drop - model.hull.half.z;
    for (const Vec3& point : {model.wheels[0], model.wheels[1], model.skids[0], model.skids[1]}) {
        Vec3 from = centre + rotation * point;
        from.z = from_height;
        const double distance = cast_ray(scene_, from, {0, 0, -1}, from_height, self);
        if (distance < nothing && distance > 0) height = std::max(height, from_height - distance);
    }
    return centre + Vec3{0, 0, height};
}

Expected<void> OdeWorld::check_free(const RobotModel& model, const std::string& name, const Pose2D& pose,
                                    Scene::Index self) {
    if (!std::isfinite(pose.position.x) || !std::isfinite(pose.position.y) || !std::isfinite(pose.heading)) {
        return failure(fmt::format("robot '{}': its pose must be of finite numbers, got x = {}, y = {}, heading = {}",
                                   name, pose.position.x, pose.position.y, pose.heading));
    }
    Shape hull = model.hull;
    hull.rotation = Rotation::yaw(pose.heading);
    hull.centre = rest_centre(model, pose, self) + Vec3{0, 0, model.hull_drop};

    std::string other;
    const auto look = [&](int touched, const Shape& shape) {
        for (const Touch& touch : narrow_.collide(hull, shape)) {
            if (touch.depth > least_overlap && other.empty()) other = name_of(touched);
        }
    };
    scene_.for_each_mover_near(hull.centre.x, hull.centre.y, model.reach, self,
                               [&](Scene::Index i, const Shape& shape) { look(touched_mover(i), shape); });
    scene_.for_each_fixed_near(hull.centre.x, hull.centre.y, model.reach, [&](Scene::Index i, const Shape& shape) {
        if (distance_from_above(shape, hull.centre.x, hull.centre.y) <= model.reach) look(touched_fixed(i), shape);
    });
    if (other.empty()) return {};
    const bool robot = std::any_of(robots_.begin(), robots_.end(), [&](const SimRobot& r) { return r.name == other; });
    return failure(fmt::format("robot '{}' at x = {:g}, y = {:g} overlaps {}{}{}: move one of them", name,
                               pose.position.x, pose.position.y,
                               robot             ? "robot '"
                               : other == "wall" ? "the arena's "
                                                 : "",
                               other, robot ? "'" : ""));
}

Truth OdeWorld::truth(RobotId id) const {
    const SimRobot& robot = robots_[id];
    const Rotation rotation = robot.body.rotation();
    const Vec3 to_origin = rotation * robot.model->origin;
    const Vec3 origin = robot.body.centre() + to_origin, velocity = robot.body.velocity_at(to_origin);
    const double heading = std::atan2(rotation.x.y, rotation.x.x);
    // The step's velocity held in the frame in which the step began; in that of its end a turning robot would seem to
    // skid.
    const double began = heading - robot.body.w[2] * step_, c = std::cos(began), s = std::sin(began);
    Truth truth;
    truth.pose = {{origin.x, origin.y}, heading};
    truth.velocity = {
        .vx = c * velocity.x + s * velocity.y, .vy = c * velocity.y - s * velocity.x, .va = robot.body.w[2]};
    truth.height = origin.z;
    truth.tilt = std::acos(std::clamp(rotation.z.z, -1.0, 1.0));
    return truth;
}

Expected<void> OdeWorld::teleport(RobotId id, Pose2D pose) {
    SimRobot& robot = robots_[id];
    if (auto free = check_free(*robot.model, robot.name, pose, robot.mover); !free) return free;
    put_body(robot.body.id, rest_centre(*robot.model, pose, robot.mover), Rotation::yaw(pose.heading));
    place_movers();
    scene_.refresh();
    may_travel_ = -1;
    return {};
}

void OdeWorld::disturb(RobotId id, const Push& push) {
    SimRobot& robot = robots_[id];
    robot.hand = {};
    // Strong enough against the wheels' grip, too weak to press a robot into a wall.
    const double force = 3 * robot.model->mass * gravity;
    if (push.vx || push.vy) {
        robot.hand.linear = JointHandle(dJointCreateLMotor(world_.get(), nullptr));
        const dJointID motor = robot.hand.linear.get();
        dJointAttach(motor, robot.body.id, nullptr);
        dJointSetLMotorNumAxes(motor, push.vx && push.vy ? 2 : 1);
        const Rotation r = robot.body.rotation();
        const Vec3& first = push.vx ? r.x : r.y;
        // `1`: the axis turns with the robot.
        dJointSetLMotorAxis(motor, 0, 1, first.x, first.y, first.z);
        // The hand's speeds are those of the body frame's origin, the motor's those of the hull's centre.
        const double side = push.va.value_or(0) * -robot.model->origin.x;
        dJointSetLMotorParam(motor, dParamVel, push.vx ? *push.vx : *push.vy + side);
        dJointSetLMotorParam(motor, dParamFMax, force);
        if (push.vx && push.vy) {
            dJointSetLMotorAxis(motor, 1, 1, r.y.x, r.y.y, r.y.z);
            dJointSetLMotorParam(motor, dParamVel2, *push.vy + side);
            dJointSetLMotorParam(motor, dParamFMax2, force);
        }
    }
    if (!push.vx && !push.vy && !push.va) return;
    robot.hand.angular = JointHandle(dJointCreateAMotor(world_.get(), nullptr));
    const dJointID motor = robot.hand.angular.get();
    dJointAttach(motor, robot.body.id, nullptr);
    dJointSetAMotorNumAxes(motor, 3);
    // A hand that pushes also holds: without that, wheels that grip would make the robot nod or fall.
    const Rotation r = robot.body.rotation();
    const double torque = force * robot.model->spec->drive.track;
    dJointSetAMotorAxis(motor, 0, 1, r.x.x, r.x.y, r.x.z);
    dJointSetAMotorAxis(motor, 1, 1, r.y.x, r.y.y, r.y.z);
    dJointSetAMotorAxis(motor, 2, 0, 0, 0, 1);
    dJointSetAMotorParam(motor, dParamFMax, torque);
    dJointSetAMotorParam(motor, dParamFMax2, torque);
    if (push.va) {
        dJointSetAMotorParam(motor, dParamVel3, *push.va);
        dJointSetAMotorParam(motor, dParamFMax3, torque);
    }
}

std::vector<ThingPose> OdeWorld::things() const {
    std::vector<ThingPose> poses;
    const auto add = [&](const Shape& shape, const Look& look) {
        const Rotation& r = shape.rotation;
        ThingPose pose;
        pose.shape = shape.kind == Shape::Kind::box ? ThingPose::Shape::box : ThingPose::Shape::cylinder;
        pose.size = to_point(shape.half * 2);
        pose.pose.position = to_point(shape.centre);
        pose.pose.orientation = {.r = std::atan2(r.y.z, r.z.z),
                                 .p = -std::asin(std::clamp(r.x.z, -1.0, 1.0)),
                                 .y = std::atan2(r.x.y, r.x.x)};
        pose.color = look.color;
        poses.push_back(std::move(pose));
    };
    for (std::size_t i = 0; i < fixed_looks_.size(); ++i) add(scene_.fixed()[i], fixed_looks_[i]);
    for (std::size_t i = 0; i < things_.size(); ++i) add(scene_.movers()[i], thing_looks_[i]);
    return poses;
}

std::string OdeWorld::name_of(int touched) const {
    if (touched == 0) return "";
    std::size_t index = static_cast<std::size_t>(touched - 1);
    if (index < fixed_looks_.size()) return fixed_looks_[index].name;
    index -= fixed_looks_.size();
    if (index < things_.size()) return thing_looks_[index].name;
    return robots_[index - things_.size()].name;
}

Expected<std::unique_ptr<World>> make_world(const ArenaSpec& arena, const PhysicsSpec& physics,
                                            std::function<void(const std::string&)> warn) {
    if (!(physics.step > 0) || !std::isfinite(physics.step)) {
        return failure(fmt::format("the physics step must be a positive number of seconds, got {:g}", physics.step));
    }
    const auto positive = [](std::initializer_list<double> extents) {
        return std::all_of(extents.begin(), extents.end(), [](double e) { return e > 0 && std::isfinite(e); });
    };
    const auto finite = [](const Point3D& p) { return is_finite(to_vec(p)); };
    for (const BoxSpec& box : arena.boxes) {
        if (!positive({box.size.x, box.size.y, box.size.z})) {
            return failure(fmt::format("a box needs a positive size, got {{ {:g}, {:g}, {:g} }}", box.size.x,
                                       box.size.y, box.size.z),
                           box.place);
        }
        if (!finite(box.at) || !std::isfinite(box.yaw) || !std::isfinite(box.pitch) || !std::isfinite(box.mass)) {
            return failure("a box needs finite numbers", box.place);
        }
    }
    for (const CylinderSpec& cylinder : arena.cylinders) {
        if (!positive({cylinder.radius, cylinder.height})) {
            return failure(fmt::format("a cylinder needs a positive radius and height, got {:g} and {:g}",
                                       cylinder.radius, cylinder.height),
                           cylinder.place);
        }
        if (!finite(cylinder.at) || !std::isfinite(cylinder.mass)) {
            return failure("a cylinder needs finite numbers", cylinder.place);
        }
    }
    if (arena.size && !positive({arena.size->x, arena.size->y})) {
        return failure(
            fmt::format("the arena needs a positive size, got {{ {:g}, {:g} }}", arena.size->x, arena.size->y));
    }
    for (const MarkerSpec& marker : arena.markers) {
        if (marker.id < 0 || marker.id >= tag_count) {
            return failure(fmt::format("marker '{}': there is no tag {}, they go from 0 to {}", marker.name, marker.id,
                                       tag_count - 1),
                           marker.place);
        }
        if (!positive({marker.size}) || !finite(marker.at) || !std::isfinite(marker.facing)) {
            return failure(fmt::format("marker '{}' needs a positive size and finite numbers", marker.name),
                           marker.place);
        }
    }
    auto world = std::make_unique<OdeWorld>(arena, physics, std::move(warn));
    if (arena.floor) {
        auto picture = read_picture(arena.floor->image);
        if (!picture) return failure("floor: " + picture.error().message, arena.floor->place);
        world->take_floor(std::move(*picture), arena.floor->size);
    }
    return world;
}

WorldFactory make_worlds_with_sound(std::string folder) {
    return
        [folder = std::move(folder)](const ArenaSpec& arena, const PhysicsSpec& physics,
                                     std::function<void(const std::string&)> warn) -> Expected<std::unique_ptr<World>> {
            std::error_code problem;
            std::filesystem::create_directories(folder, problem);
            if (problem || !std::filesystem::is_directory(folder, problem)) {
                return failure(fmt::format("'{}' can't be made a folder for sounds{}", folder,
                                           problem ? ": " + problem.message() : ""));
            }
            auto world = make_world(arena, physics, std::move(warn));
            if (world) static_cast<OdeWorld&>(**world).keep_sounds(folder);
            return world;
        };
}

}  // namespace nezumi::sim
