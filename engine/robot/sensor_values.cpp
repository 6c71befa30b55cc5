// Responses, limits and noise of a robot's sensors.
#include "engine/robot/sensor_values.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/ports/payload.hpp"

namespace nezumi {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// A number in (0, 1] from a hash.
double uniform(std::uint64_t hash) { return (static_cast<double>(hash >> 11) + 1.0) * 0x1p-53; }

}  // namespace

SensorValues::SensorValues(const RobotSpec& spec, std::uint64_t seed)
    : spec_(spec), seed_(seed), values_(spec.sensors.size()), lengths_(spec.sensors.size(), infinity) {
    for (std::size_t i = 0; i < spec.sensors.size(); ++i) {
        if (spec.sensors[i].kind == SensorSpec::Kind::range) range_sensors_.push_back(i);
    }
    seen_.assign(range_sensors_.size(), infinity);
}

double SensorValues::with_noise(std::size_t sensor, double value, std::int64_t tick) const {
    const double deviation = spec_.sensors[sensor].noise;
    if (deviation <= 0) return value;
    // Box and Muller (1958), from hashes of (seed, sensor, tick): no state, so any tick can be drawn again.
    const std::uint64_t hash = mix(mix(seed_, sensor), static_cast<std::uint64_t>(tick));
    const double radius = std::sqrt(-2 * std::log(uniform(hash)));
    return value + deviation * radius * std::cos(2 * std::numbers::pi * uniform(mix(hash, 1)));
}

void SensorValues::read_ranges(const RobotBody& body, std::int64_t tick) {
    body.read_ranges(seen_);
    for (std::size_t i = 0; i < range_sensors_.size(); ++i) {
        const std::size_t index = range_sensors_[i];
        const SensorSpec& sensor = spec_.sensors[index];
        const double seen = seen_[i];
        lengths_[index] = seen < sensor.range ? std::max(seen, sensor.minimum) : sensor.range;
        values_[index] = sensor.has_response ? sensor.response(seen) : lengths_[index];
        // An echo that does not come back has no length that could be measured wrongly.
        if (sensor.noise > 0 && (sensor.has_response || seen < sensor.range)) {
            const double noisy = with_noise(index, values_[index], tick);
            values_[index] =
                sensor.has_response ? sensor.response.clamp(noisy) : std::clamp(noisy, sensor.minimum, sensor.range);
            if (!sensor.has_response) lengths_[index] = values_[index];
        }
    }
}

void SensorValues::read(const RobotBody& body, const Time& now, double period) {
    read_ranges(body, now.tick);
    if (range_sensors_.size() == spec_.sensors.size()) return;
    for (std::size_t i = 0; i < spec_.sensors.size(); ++i) {
        const SensorSpec& sensor = spec_.sensors[i];
        switch (sensor.kind) {
            case SensorSpec::Kind::button:
            case SensorSpec::Kind::touch: values_[i] = body.is_pressed(i) ? 1 : 0; break;
            case SensorSpec::Kind::gyro: {
                const double turned = body.yaw_rate();
                const double felt =
                    sensor.max_rate > 0 ? std::clamp(turned, -sensor.max_rate, sensor.max_rate) : turned;
                gyro_angle_ += (felt + sensor.drift) * period;
                values_[i] = with_noise(i, gyro_angle_, now.tick);
                break;
            }
            case SensorSpec::Kind::color: values_[i] = static_cast<double>(body.floor_color(i)); break;
            case SensorSpec::Kind::reflect:
                values_[i] = std::clamp(with_noise(i, body.reflected_light(i), now.tick), 0.0, 100.0);
                break;
            case SensorSpec::Kind::range: break;
        }
    }
}

}  // namespace nezumi
