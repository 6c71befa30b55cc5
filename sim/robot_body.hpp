// What the engine holds of a simulated robot.
#pragma once

#include "engine/world/world.hpp"

namespace nezumi::sim {

class OdeWorld;

class SimRobotBody final : public RobotBody {
public:
    /// `world` must outlive it; destroying it takes the robot out of the world.
    SimRobotBody(OdeWorld& world, RobotId id) : world_(world), id_(id) {}
    ~SimRobotBody() override;
    SimRobotBody(const SimRobotBody&) = delete;
    SimRobotBody& operator=(const SimRobotBody&) = delete;

    Wheels wheel_angles() const override;
    void read_ranges(std::span<double> distances) const override;
    bool is_pressed(std::size_t index) const override;
    double yaw_rate() const override;
    FloorColor floor_color(std::size_t index) const override;
    double reflected_light(std::size_t index) const override;
    void set_wheel_speeds(Wheels speeds) override;
    void coast() override;
    void set_servo(std::size_t index, double angle) override;
    void play(const Sound& sound) override;

private:
    OdeWorld& world_;
    RobotId id_;
};

}  // namespace nezumi::sim
