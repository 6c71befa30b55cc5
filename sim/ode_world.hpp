// A world of robots and things on ODE.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sim/camera.hpp"
#include "sim/narrow_phase.hpp"
#include "sim/ode_library.hpp"
#include "sim/robot_model.hpp"
#include "sim/scene.hpp"
#include "sim/sound_files.hpp"
#include "sim/world.hpp"

namespace nezumi::sim {

/// A body of ODE, read through the pointers that it keeps for life.
struct BodyView {
    explicit BodyView(dBodyID body)
        : id(body),
          p(dBodyGetPosition(body)),
          r(dBodyGetRotation(body)),
          v(dBodyGetLinearVel(body)),
          w(dBodyGetAngularVel(body)) {}

    Vec3 centre() const { return {p[0], p[1], p[2]}; }
    Rotation rotation() const { return {{r[0], r[4], r[8]}, {r[1], r[5], r[9]}, {r[2], r[6], r[10]}}; }
    Vec3 velocity() const { return {v[0], v[1], v[2]}; }
    Vec3 spin() const { return {w[0], w[1], w[2]}; }
    /// Velocity [m/s] of the point that is now at `from_centre` from the centre, in the world's directions.
    Vec3 velocity_at(const Vec3& from_centre) const { return velocity() + cross(spin(), from_centre); }
    /// Whether it is somewhere and no faster than anything here can be.
    bool is_sound() const { return is_finite(centre()) && is_finite(spin()) && dot(velocity(), velocity()) < 1e6; }

    dBodyID id;
    const dReal *p, *r, *v, *w;
};

/// Puts the hull of a robot to where its body is.
inline void place_hull(Shape& hull, const RobotModel& model, const BodyView& body) {
    hull.rotation = body.rotation();
    hull.centre = body.centre() + hull.rotation.z * model.hull_drop;
}

/// Who is near a mover: the only ones that are looked at in a step.
struct Neighbours {
    std::vector<Scene::Index> fixed;
    std::vector<Scene::Index> movers;
};

/// The joints with which a hand forces speeds on a robot.
struct Hand {
    JointHandle linear, angular;
};

struct SimRobot {
    SimRobot(dBodyID id, RobotModel& its_model, Scene::Index its_mover, std::string its_name)
        : body(id),
          model(&its_model),
          mover(its_mover),
          name(std::move(its_name)),
          pressed(model->spec->sensors.size(), false),
          servos(model->spec->actuators.size(), 0.0) {}

    BodyView body;
    RobotModel* model;  // its contacts are filled in on the way to ODE
    Scene::Index mover;
    bool gone = false;  // removed: nobody meets or sees it any more, and its number is not given again
    bool has_neighbours = false;
    bool coasting = false;
    Wheels speeds;    // [m/s]
    Wheels angles;    // [rad]
    int touched = 0;  // what it touched first in this call of `step`: 0, or a number that `OdeWorld::name_of` knows
    Neighbours near;
    std::string name;
    Hand hand;
    std::vector<bool> pressed;           // by sensor of the spec
    std::vector<double> servos;          // [rad] by actuator of the spec
    std::unique_ptr<RayFan> turned_fan;  // once a servo that carries a sensor has moved
};

/// A movable box or cylinder.
struct Thing {
    Thing(dBodyID id, Scene::Index its_mover, double its_mass) : body(id), mover(its_mover), mass(its_mass) {}

    BodyView body;
    Scene::Index mover;
    double mass;
    bool asleep = false;
    int quiet_steps = 0;
    Neighbours near;
};

class OdeWorld final : public World {
public:
    OdeWorld(const ArenaSpec& arena, const PhysicsSpec& physics, std::function<void(const std::string&)> warn);
    ~OdeWorld() override;
    OdeWorld(const OdeWorld&) = delete;
    OdeWorld& operator=(const OdeWorld&) = delete;

    Expected<std::unique_ptr<RobotBody>> add_robot(const std::string& name, const RobotSpec& spec,
                                                   Pose2D pose) override;
    /// Takes a robot out of the world, for good.
    void remove_robot(RobotId robot);
    void step(int count) override;
    const Error* breakdown() const override { return breakdown_ ? &*breakdown_ : nullptr; }
    Truth truth(RobotId robot) const override;
    bool collided(RobotId robot) const override { return robots_[robot].touched != 0; }
    std::string collided_with(RobotId robot) const override { return name_of(robots_[robot].touched); }
    Expected<void> teleport(RobotId robot, Pose2D pose) override;
    void disturb(RobotId robot, const Push& push) override;
    void press(RobotId robot, std::size_t sensor, bool pressed) override;
    std::vector<ThingPose> things() const override;
    std::vector<Ray> rays(RobotId robot) const override;
    std::vector<MarkerPose> markers() const override;
    Expected<void> move_marker(std::string_view name, const Pose3D& pose) override;
    Expected<std::unique_ptr<CameraSource>> open_camera(const CameraMount& mount,
                                                        const CameraSettings& settings) override;

    // What a camera asks.
    View frame_of(RobotId robot) const;
    void list_solids(std::optional<RobotId> except, Rgb robots, std::vector<Solid>& solids) const;
    const Picture* floor_picture() const { return floor_ ? &*floor_ : nullptr; }
    Point2D floor_size() const { return floor_size_; }
    void take_floor(Picture picture, Point2D size) {
        floor_ = std::move(picture);
        floor_size_ = size;
    }

    // What a `RobotBody` asks.
    SimRobot& robot(RobotId id) { return robots_[id]; }
    const SimRobot& robot(RobotId id) const { return robots_[id]; }
    void read_ranges(const SimRobot& robot, std::span<double> distances) const;
    bool touches_something(const SimRobot& robot, const SensorSpec& touch_sensor) const;
    /// What a sensor that looks down sees: nothing beside the floor's picture, or from too high.
    std::optional<Rgb> floor_under(const SimRobot& robot, const SensorSpec& sensor) const;
    void play(const SimRobot& robot, const Sound& sound) {
        if (sounds_ != nullptr) sounds_->play(robot.name, sound);
    }
    /// From now on sounds become files in this folder.
    void keep_sounds(const std::string& folder) { sounds_ = std::make_unique<SoundFiles>(folder, warn_); }

private:
    // Building (ode_world.cpp).
    void add_box(const BoxSpec& box, std::string name);
    void add_cylinder(const CylinderSpec& cylinder, std::string name);
    void add_shape(const Shape& shape, double mass, std::string name, const std::string& color);
    void add_border(const ArenaSpec& arena);
    RobotModel& model_of(const RobotSpec& spec);
    Expected<void> check_free(const RobotModel& model, const std::string& name, const Pose2D& pose, Scene::Index self);
    Vec3 rest_centre(const RobotModel& model, const Pose2D& pose, Scene::Index self) const;
    std::string name_of(int touched) const;

    // Stepping (ode_world_step.cpp).
    void step_once();
    void place_movers();
    void place(const Thing& thing);
    void place_neighbours();
    void list_neighbours();
    void advance();
    bool find_large_islands();
    void advance_large_islands();
    void turn_wheels();
    void tend_things();
    void restore_lost_bodies();
    void restore(const BodyView& body, const Shape& last, double drop, const std::string& name);

    // Contacts (contacts.cpp).
    void touch_floor(SimRobot& robot);
    void touch_neighbours(SimRobot& robot);
    void touch_fixed(SimRobot& robot, Scene::Index fixed);
    void touch_thing(SimRobot& robot, Scene::Index thing);
    void touch_robot(SimRobot& robot, SimRobot& other);
    bool roll_over(SimRobot& robot, const Shape& shape, dBodyID other);
    int touch_beside(SimRobot& robot, const Shape& shape, dBodyID other, const Spring& spring);
    void touch_floor(Thing& thing);
    void touch_neighbours(Thing& thing);
    void touch_floor_with(const Shape& shape, dBodyID body, const Spring& spring, double friction);
    void add_wheel_contact(SimRobot& robot, int side, const Touch& touch, const Vec3& forward, dBodyID other);
    void add_skid_contact(SimRobot& robot, const Touch& touch, dBodyID other);
    void add_contact(dBodyID a, dBodyID b, const Touch& touch, const Spring& spring, double friction);
    void attach(const dContact& contact, dBodyID a, dBodyID b);
    void wake(Thing& thing);

    // What `SimRobot::touched` holds for each kind, from 1.
    int touched_fixed(Scene::Index fixed) const { return 1 + static_cast<int>(fixed); }
    int touched_mover(Scene::Index mover) const { return 1 + static_cast<int>(scene_.fixed().size() + mover); }
    bool is_thing(Scene::Index mover) const { return mover < things_.size(); }
    SimRobot& robot_of(Scene::Index mover) { return robots_[mover - things_.size()]; }

    double step_;
    unsigned long random_;  // ODE's generator, as far as this world has drawn from it
    OdeMessages::Sink warn_;
    std::set<std::string> warned_;
    std::optional<Error> breakdown_;

    // Declaration order is destruction order reversed: the library must die last, joints before their world.
    OdeLibrary library_;
    ThreadingHandle threading_;
    WorldHandle world_;
    JointGroupHandle contacts_;
    NarrowPhase narrow_;

    Scene scene_;  // its movers are first the things, then the robots
    std::map<const RobotSpec*, std::unique_ptr<RobotModel>> models_;
    std::vector<Thing> things_;
    std::vector<SimRobot> robots_;

    struct Look {
        std::string name;
        std::string color;
    };
    std::vector<Look> fixed_looks_, thing_looks_;
    std::vector<MarkerPose> markers_;
    std::optional<Picture> floor_;
    Point2D floor_size_{};
    std::unique_ptr<SoundFiles> sounds_;  // dies before what it warns through

    double may_travel_ = -1;  // [m] that nobody may exceed before neighbours are listed anew
    std::vector<std::pair<Scene::Index, Scene::Index>> links_;  // movers that touch each other in this step
    // By mover:
    std::vector<int> rows_;              // equations of its contacts in this step, but for those with the floor
    std::vector<Scene::Index> parents_;  // of the search for islands; each its own when idle
    std::vector<bool> large_;            // what that search found
};

/// What the engine holds of a robot.
class SimRobotBody final : public RobotBody {
public:
    SimRobotBody(OdeWorld& world, RobotId id) : world_(world), id_(id) {}
    ~SimRobotBody() override { world_.remove_robot(id_); }
    SimRobotBody(const SimRobotBody&) = delete;
    SimRobotBody& operator=(const SimRobotBody&) = delete;

    Wheels wheel_angles() const override { return world_.robot(id_).angles; }
    void read_ranges(std::span<double> distances) const override { world_.read_ranges(world_.robot(id_), distances); }
    bool is_pressed(std::size_t index) const override;
    double yaw_rate() const override { return world_.robot(id_).body.w[2]; }
    FloorColor floor_color(std::size_t index) const override;
    double reflected_light(std::size_t index) const override;
    void set_wheel_speeds(Wheels speeds) override;
    void coast() override { world_.robot(id_).coasting = true; }
    void set_servo(std::size_t index, double angle) override;
    void play(const Sound& sound) override { world_.play(world_.robot(id_), sound); }

private:
    OdeWorld& world_;
    RobotId id_;
};

}  // namespace nezumi::sim
