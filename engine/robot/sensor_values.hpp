// What a robot's sensors say in a tick: distances become values, and noise is drawn from the run's seed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/ports/port.hpp"
#include "engine/world/robot_spec.hpp"
#include "engine/world/world.hpp"

namespace nezumi {

class SensorValues {
public:
    /// `spec` must outlive this. The same `seed` draws the same noise.
    SensorValues(const RobotSpec& spec, std::uint64_t seed);

    /// Reads every sensor of the spec from the body, `period` [s] after the last time.
    void read(const RobotBody& body, const Time& now, double period);

    /// The value of sensor `index` of the spec: what its response makes of it, 0 or 1, an angle [rad], ...
    double value(std::size_t index) const { return values_[index]; }
    /// The distance [m] that a range sensor measured, its range with nothing in sight.
    double distance(std::size_t index) const { return lengths_[index]; }

private:
    double with_noise(std::size_t sensor, double value, std::int64_t tick) const;
    void read_ranges(const RobotBody& body, std::int64_t tick);

    const RobotSpec& spec_;
    std::uint64_t seed_;
    std::vector<std::size_t> range_sensors_;  // indices into spec_.sensors, in order
    std::vector<double> seen_;                // of the range sensors
    std::vector<double> values_;              // of all sensors
    std::vector<double> lengths_;             // of all sensors, where they have one
    double gyro_angle_ = 0;
};

}  // namespace nezumi
