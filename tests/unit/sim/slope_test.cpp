// Robots that stand on a slope: held wheels hold up to the friction angle.
#include "sim/ode_world.hpp"
#include "tests/unit/sim/try_world.hpp"

using namespace nezumi;
using namespace nezumi::sim;

namespace {

constexpr double step = 0.005;  // [s]

// A robot that stands, or slides, on a slope that goes down along x.
struct OnSlope {
    OnSlope(RobotSpec its_spec, double angle, double heading, double friction = 1)
        : spec(std::move(its_spec)), world(arena_of(angle), {.step = step, .seed = 1}, nullptr) {
        spec.friction = friction;
        body = std::move(*world.add_robot("robot", spec, {{0.0, 5.0}, 0.0}));  // beside the slope
        const SimRobot& robot = world.robot(0);
        const Rotation rotation = yaw_pitch_rotation(0, angle) * yaw_rotation(heading);
        // The slope's surface goes through the origin of the body's frame.
        robot.body.put(Vec3{0, 0, 2} - rotate(rotation, robot.model->origin), rotation);
        body->set_wheel_speeds({0, 0});
        run(1);
    }
    static ArenaSpec arena_of(double angle) {
        ArenaSpec arena;
        const Vec3 centre = Vec3{0, 0, 2} - yaw_pitch_rotation(0, angle).col(2) * 0.05;
        arena.boxes.push_back({.at = {centre.x(), centre.y(), centre.z()}, .size = {4, 4, 0.1}, .pitch = angle});
        return arena;
    }
    void run(double seconds) { world.step(static_cast<int>(std::lround(seconds / step))); }
    double way_in(double seconds) {
        const Point3D from = world.pose(0).position;
        run(seconds);
        const Point3D to = world.pose(0).position;
        return std::hypot(to.x - from.x, to.y - from.y, to.z - from.z);
    }

    RobotSpec spec;
    OdeWorld world;
    std::unique_ptr<RobotBody> body;
};

const std::vector<double> headings{0, M_PI, M_PI / 2, -M_PI / 2, M_PI / 4};

}  // namespace

TEST_CASE("a standing robot stays where it is on a slope, along and across", "[sim][slope]") {
    for (const RobotSpec& spec : {mouse_spec(), swarm_spec()}) {
        for (const double degrees : {1.0, 6.0, 20.0}) {
            for (const double heading : headings) {
                CAPTURE(spec.model, degrees, heading);
                OnSlope robot(spec, degrees * M_PI / 180, heading);
                const double before = robot.world.robot(0).angles.left;
                const double turned = robot.world.truth(0).pose.heading;
                CHECK(robot.way_in(60) < 1e-4);
                CHECK(std::abs(std::remainder(robot.world.truth(0).pose.heading - turned, 2 * M_PI)) < 1e-3);
                CHECK(robot.world.truth(0).tilt == Approx(degrees * M_PI / 180).margin(0.1));
                CHECK(robot.world.robot(0).angles.left == before);
            }
        }
    }
}

TEST_CASE("a standing robot holds up to the angle of friction and slides beyond it", "[sim][slope]") {
    for (const double friction : {0.1, 0.3, 0.6}) {
        for (const double heading : {0.0, M_PI, M_PI / 2, -M_PI / 2}) {
            CAPTURE(friction, heading);
            if (friction > 0.5 && std::abs(std::cos(heading)) > 0.5) continue;  // along the slope it tips over first
            OnSlope holds(mouse_spec(), 0.93 * std::atan(friction), heading, friction);
            CHECK(holds.way_in(10) < 1e-4);
            OnSlope slides(mouse_spec(), 1.07 * std::atan(friction), heading, friction);
            CHECK(slides.way_in(1) > 5e-3);
        }
    }
}

TEST_CASE("a robot that stops on a slope stays there, and rolls down when its wheels are released", "[sim][slope]") {
    OnSlope robot(mouse_spec(), 0.1, M_PI);  // looks up
    robot.body->set_wheel_speeds({0.1, 0.1});
    CHECK(robot.way_in(2) == Approx(0.2).epsilon(0.03));
    robot.body->set_wheel_speeds({0, 0});
    robot.run(0.5);
    CHECK(robot.way_in(10) < 1e-4);
    robot.body->coast();
    CHECK(robot.way_in(1) > 0.1);
}
