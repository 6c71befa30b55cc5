// A world of robots and things in ODE.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "sim/bodies.hpp"
#include "sim/camera.hpp"
#include "sim/contacts.hpp"
#include "sim/islands.hpp"
#include "sim/narrow_phase.hpp"
#include "sim/neighbour_lists.hpp"
#include "sim/ode_library.hpp"
#include "sim/robot_model.hpp"
#include "sim/rolling_ahead.hpp"
#include "sim/scene.hpp"
#include "sim/simulated_body.hpp"
#include "sim/sound_files.hpp"
#include "sim/world.hpp"

namespace nezumi::sim {

/// [m] Smaller overlaps of things are allowed, because users stack things only roughly.
inline constexpr double least_overlap_of_things = 1e-3;

class Distortion;

class OdeWorld final : public World {
public:
    OdeWorld(const ArenaSpec& arena, const PhysicsSpec& physics, std::function<void(const std::string&)> warn);
    ~OdeWorld() override;
    OdeWorld(const OdeWorld&) = delete;
    OdeWorld& operator=(const OdeWorld&) = delete;

    Expected<std::unique_ptr<RobotBody>> add_robot(const std::string& name, const RobotSpec& spec,
                                                   Pose2D pose) override;
    /// Checks that no movable thing overlaps another shape by more than `least_overlap_of_things`. Call it before
    /// robots are added.
    Expected<void> check_things();
    /// Removes a robot from the world permanently.
    void remove_robot(RobotId robot);
    void step(int count) override;
    void use_threads(WorkerPool* threads) override { ahead_.use(threads); }
    const Error* breakdown() const override { return breakdown_ ? &*breakdown_ : nullptr; }
    Truth truth(RobotId robot) const override;
    bool collided(RobotId id) const override { return robot(id).touched.has_value(); }
    std::string collided_with(RobotId id) const override { return collided(id) ? name_of(*robot(id).touched) : ""; }
    std::optional<double> clearance(RobotId id, double most) const override;
    std::vector<Point3D> contact_points(RobotId robot) const override;
    Pose3D pose(RobotId robot) const override;
    Expected<void> teleport(RobotId robot, Pose2D pose) override;
    Expected<void> move_thing(std::string_view name, const Pose2D& pose) override;
    void disturb(RobotId robot, const VelocityConstraint& constraint) override;
    void press(RobotId robot, std::size_t sensor, bool pressed) override;
    std::vector<ThingPose> things() const override;
    std::vector<Ray> rays(RobotId robot) const override;
    std::vector<MarkerPose> markers() const override;
    std::vector<std::string> marker_cells(int id) const override;
    Expected<void> move_marker(std::string_view name, const Pose3D& pose) override;
    Expected<void> add_marker(const MarkerSpec& marker) override;
    Expected<void> remove_marker(std::string_view name) override;
    Expected<std::unique_ptr<CameraSource>> open_camera(const CameraMount& mount,
                                                        const CameraSettings& settings) override;

    // For cameras.
    View frame_of(RobotId robot) const;
    void list_solids(std::optional<RobotId> except, Rgb robots, std::vector<Solid>& solids) const;
    const Picture* floor_picture() const { return floor_ ? &*floor_ : nullptr; }
    Point2D floor_size() const { return floor_size_; }
    void take_floor(Picture picture, Point2D size) {
        floor_ = std::move(picture);
        floor_size_ = size;
    }

    // For `RobotBody`.
    SimRobot& robot(RobotId id) { return movers_.robots[id]; }
    const SimRobot& robot(RobotId id) const { return movers_.robots[id]; }
    void read_ranges(const SimRobot& robot, std::span<double> distances, std::span<const std::uint8_t> due) const;
    /// Appends the other robots within the sensor's radius, unless something is between.
    void list_neighbours(const SimRobot& robot, const SensorSpec& neighbours,
                         std::vector<SimulatedBody::InSight>& seen) const;
    /// Returns the robot's message and lights, to be changed. Others see the change from the next step on. Threads may
    /// call this at the same time for different robots.
    Signals& change_signals(RobotId id);
    bool touches_something(const SimRobot& robot, const SensorSpec& touch_sensor) const;
    /// The floor's colour for a downward-looking sensor. No value outside the floor's picture, or if the sensor is too
    /// high.
    std::optional<Rgb> floor_under(const SimRobot& robot, const SensorSpec& sensor) const;
    void play(const SimRobot& robot, const Sound& sound) {
        if (sounds_ != nullptr) sounds_->play(robot.name, sound);
    }
    /// The number of robots that took the last steps one by one.
    std::size_t one_by_one() const { return ahead_.others().size(); }
    /// Writes sounds to files in this folder from now on.
    void keep_sounds(const std::string& folder) { sounds_ = std::make_unique<SoundFiles>(folder, warn_); }

private:
    // Building and queries (ode_world.cpp).
    struct Label {
        std::string name;
        std::string color;
        Place place{};
    };
    void add_box(const BoxSpec& box, std::string name);
    void add_cylinder(const CylinderSpec& cylinder, std::string name);
    void add_shape(const Shape& shape, double mass, Label label);
    void add_border(const ArenaSpec& arena);
    RobotModel& model_of(const RobotSpec& spec);
    /// Fails with the reason if the robot can't stand at this pose.
    Expected<void> check_free(const RobotModel& model, const std::string& name, const Pose2D& pose, Scene::Index self);
    void warn_of_high_rays(const std::string& name, const RobotSpec& spec) const;
    Vec3 rest_centre(const RobotModel& model, const Pose2D& pose, Scene::Index self) const;
    std::string name_of(const Obstacle& obstacle) const;
    struct Overlap {
        std::string other;  // as named in messages
        double depth;       // [m]
    };
    /// Returns the first shape, except `self`, that overlaps this shape by more than `least`.
    std::optional<Overlap> find_overlap(const Shape& shape, double reach, Scene::Index self, double least,
                                        bool looks_at_fixed = true);
    Expected<void> check_inside(const std::string& what, const Point2D& at) const;
    // Moving objects in the arena (moving.cpp).
    Expected<void> move_label(const Label& label, Shape& shape, const Pose2D& pose, Scene::Index self);

    // Stepping (stepping.cpp).
    void publish_signals();
    int step_together(int most);
    void step_others(int index);
    void place(const Thing& thing);
    void place_movers();
    void place_awake();
    void settle();
    void advance();
    void advance_large_islands();
    void turn_wheels();
    void measure_travel(int index);
    void tend_things();
    void restore_lost_bodies();
    void tell_who_left();
    void restore(const BodyView& body, const Shape& last, double drop, const std::string& name);

    double step_;
    std::uint64_t seed_;             // of the sensors' noise
    std::optional<Point2D> inside_;  // [m] size of an arena that robots can't leave
    unsigned long random_;           // state of ODE's generator for this world
    OdeMessages::Sink warn_;
    std::set<std::string> warned_;
    std::optional<Error> breakdown_;

    // Members are destroyed in reverse order: the library must be last, and joints before their world.
    OdeLibrary library_;
    ThreadingHandle threading_;
    WorldHandle world_;

    Scene scene_;
    Movers movers_;
    std::map<const RobotSpec*, std::unique_ptr<RobotModel>> models_;
    NarrowPhase narrow_;  // for queries between steps
    Islands islands_;
    NeighbourLists neighbours_;
    RollingAhead ahead_;
    Contacts contacts_;

    std::vector<Label> fixed_labels_, thing_labels_;
    std::vector<MarkerPose> markers_;
    struct ShownSignals {
        Signals now, next;
        bool have_changed = false;
    };
    std::vector<ShownSignals> signals_;  // index: robot
    std::atomic<bool> signals_have_changed_ = false;
    std::optional<Picture> floor_;
    Point2D floor_size_{};
    // Of the camera that was opened last: cameras of the same kind share it.
    std::shared_ptr<const Distortion> last_distortion_;
    std::unique_ptr<SoundFiles> sounds_;  // must be destroyed before the members that its warnings use
};

}  // namespace nezumi::sim
