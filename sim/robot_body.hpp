// A simulated robot as the engine sees it.
#pragma once

#include "sim/simulated_body.hpp"

namespace nezumi::sim {

class OdeWorld;

class SimRobotBody final : public SimulatedBody {
public:
    /// `world` and `spec` must outlive this object. The destructor removes the robot from the world. `seed` is for
    /// sensor noise.
    SimRobotBody(OdeWorld& world, RobotId id, const RobotSpec& spec, std::uint64_t seed)
        : SimulatedBody(spec, seed), world_(world), id_(id) {}
    ~SimRobotBody() override;
    SimRobotBody(const SimRobotBody&) = delete;
    SimRobotBody& operator=(const SimRobotBody&) = delete;

    RobotId id() const override { return id_; }
    Wheels wheel_angles() const override;
    using SimulatedBody::read_ranges;
    void read_ranges(std::span<double> distances, std::span<const std::uint8_t> due) const override;
    bool is_pressed(std::size_t index) const override;
    double yaw_rate() const override;
    PlaceMotion motion(std::size_t index) const override;
    FloorColor floor_color(std::size_t index) const override;
    double reflected_light(std::size_t index) const override;
    void list_neighbours(std::size_t index, std::vector<InSight>& seen) const override;
    void say(std::span<const double> message) override;
    void set_leds(const std::vector<bool>& on) override;
    void set_wheel_speeds(Wheels speeds) override;
    void coast() override;
    void set_servo(std::size_t index, double angle) override;
    void play(const Sound& sound) override;

private:
    OdeWorld& world_;
    RobotId id_;
};

}  // namespace nezumi::sim
