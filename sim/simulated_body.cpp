// Responses, limits and noise of a robot's sensors, the pulses of its encoders, the speed of its servos.
#include "sim/simulated_body.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "engine/ports/payload.hpp"

namespace nezumi::sim {
namespace {

// Returns a number in (0, 1] from a hash.
double uniform(std::uint64_t hash) { return (static_cast<double>(hash >> 11) + 1.0) * 0x1p-53; }

// Up to this number, distances are stored on the stack: they are needed only here.
constexpr std::size_t few_rays = 64;

// The number of distances that a sensor measures.
std::size_t rays_of(const SensorSpec& sensor) {
    if (sensor.kind == SensorSpec::Kind::scan) return static_cast<std::size_t>(sensor.rays);
    return sensor.kind == SensorSpec::Kind::range ? 1 : 0;
}

}  // namespace

SimulatedBody::SimulatedBody(const RobotSpec& spec, std::uint64_t seed)
    : spec_(spec), seed_(seed), readings_(spec.sensors.size()), servos_(spec.actuators.size()) {
    bool has_scan = false;
    for (std::size_t i = 0; i < spec.sensors.size(); ++i) {
        has_scan = has_scan || spec.sensors[i].kind == SensorSpec::Kind::scan;
        if (spec.sensors[i].kind == SensorSpec::Kind::imu) inertial_.push_back({.sensor = i});
        if (spec.sensors[i].kind == SensorSpec::Kind::neighbours) around_.push_back({.sensor = i});
        rays_ += rays_of(spec.sensors[i]);
    }
    if (has_scan || rays_ > few_rays) seen_.resize(rays_);
    for (SensorReading& reading : readings_) reading.is_there = true;
}

std::uint64_t SimulatedBody::hash_of(const Draw& draw) const {
    const std::uint64_t hash = mix(mix(seed_, draw.sensor), static_cast<std::uint64_t>(draw.tick));
    return draw.part > 0 ? mix(hash, draw.part + 1) : hash;
}

double SimulatedBody::with_noise(const Draw& draw, double value, double deviation) const {
    // The sensor's deviation and the robot's relative noise are independent, so their squares are added.
    const double both = spec_.noise > 0 ? std::hypot(deviation, spec_.noise * value) : deviation;
    if (both <= 0) return value;
    // Box and Muller (1958), from hashes of (seed, sensor, tick). There is no state, so any tick can be computed again.
    const std::uint64_t hash = hash_of(draw);
    const double radius = std::sqrt(-2 * std::log(uniform(hash)));
    return value + both * radius * std::cos(2 * std::numbers::pi * uniform(mix(hash, 1)));
}

WheelReading SimulatedBody::read_wheels(const Time& now, double period) {
    turn_servos(period);
    const Wheels angles = wheel_angles();
    const double pulse = 2 * std::numbers::pi / spec_.drive.encoder_pulses();
    const auto counted = [&](double angle) { return static_cast<std::int64_t>(std::floor(angle / pulse + 0.5)); };
    WheelReading reading{.is_there = true,
                         .tm = now.seconds,
                         .pulses = {.left = counted(angles.left), .right = counted(angles.right)},
                         .speeds = {}};
    if (has_read_wheels_) {
        const double rate = 1 / period;
        reading.speeds = {.left = (angles.left - angles_.left) * spec_.drive.radius_of_left() * rate,
                          .right = (angles.right - angles_.right) * spec_.drive.radius_of_right() * rate};
    }
    angles_ = angles;
    has_read_wheels_ = true;
    return reading;
}

// A distance with noise; the range, without noise, if nothing is in sight.
double SimulatedBody::seen_by(const SensorSpec& sensor, const Draw& draw, double distance) const {
    if (distance >= sensor.range) return sensor.range;
    return std::clamp(with_noise(draw, std::max(distance, sensor.minimum), sensor.noise), sensor.minimum, sensor.range);
}

void SimulatedBody::measure_range(const Draw& draw, double seen, SensorReading& reading) const {
    const SensorSpec& sensor = spec_.sensors[draw.sensor];
    if (!sensor.has_response) {
        reading.physical = reading.value = seen_by(sensor, draw, seen);
        return;
    }
    reading.physical = seen < sensor.range ? std::max(seen, sensor.minimum) : sensor.range;
    reading.value = sensor.response(seen);
    if (sensor.noise <= 0 && spec_.noise <= 0) return;
    const double noisy = with_noise(draw, reading.value, sensor.noise);
    if (noisy == reading.value) return;
    // The distance is computed from the value with noise, so that both agree.
    reading.value = sensor.response.clamp(noisy);
    reading.physical = std::clamp(distance_at(sensor.response, reading.value), sensor.minimum, sensor.range);
}

// An accelerometer measures the supporting force: gravity upwards at rest. Accelerations are the mean since the last
// reading.
void SimulatedBody::measure_motion(std::int64_t tick, double period) {
    constexpr double gravity = 9.81;  // [m/s^2]
    const auto dot = [](const Point3D& a, const Point3D& b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
    for (Inertial& each : inertial_) {
        const SensorSpec& sensor = spec_.sensors[each.sensor];
        const PlaceMotion motion = this->motion(each.sensor);
        const Point3D& now = motion.velocity;
        const Point3D before = each.before.value_or(now);
        each.before = now;
        const Point3D felt{(now.x - before.x) / period, (now.y - before.y) / period,
                           (now.z - before.z) / period + gravity};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double turned = dot(motion.axes[axis], motion.spin);
            const double rate = sensor.max_rate > 0 ? std::clamp(turned, -sensor.max_rate, sensor.max_rate) : turned;
            each.values[axis] = with_noise({each.sensor, tick, axis}, rate, sensor.noise);
            each.values[axis + 3] =
                with_noise({each.sensor, tick, axis + 3}, dot(motion.axes[axis], felt), sensor.acceleration_noise);
        }
    }
}

// Random numbers depend only on the robot that is seen, not on the other robots in sight.
void SimulatedBody::look_around(std::int64_t tick) {
    for (Around& each : around_) {
        if (!each.is_due) continue;
        const SensorSpec& sensor = spec_.sensors[each.sensor];
        auto& list = each.in_sight;
        list.clear();
        list_neighbours(each.sensor, list);
        const auto draw = [&](RobotId id, std::size_t what) { return Draw{each.sensor, tick, 3 * id + what}; };
        if (sensor.loss > 0)
            std::erase_if(list, [&](const InSight& one) { return uniform(hash_of(draw(one.id, 1))) <= sensor.loss; });
        for (InSight& one : list) {
            one.range = std::max(0.0, with_noise(draw(one.id, 2), one.range, sensor.noise));
            one.bearing = std::remainder(one.bearing + with_noise(draw(one.id, 3), 0, sensor.bearing_noise),
                                         2 * std::numbers::pi);
        }
        std::sort(list.begin(), list.end(), [](const InSight& one, const InSight& other) {
            return std::tie(one.range, one.id) < std::tie(other.range, other.id);
        });
        each.seen.resize(list.size());
        for (std::size_t i = 0; i < list.size(); ++i) {
            Neighbour& seen = each.seen[i];
            seen.name = list[i].name;
            seen.range = list[i].range;
            seen.bearing = list[i].bearing;
            seen.message = list[i].signals->message;
            seen.leds = list[i].signals->leds;
        }
    }
}

std::span<const Neighbour> SimulatedBody::neighbours(std::size_t index) const {
    for (const Around& each : around_) {
        if (each.sensor == index) return each.seen;
    }
    return {};
}

std::span<const SensorReading> SimulatedBody::read_sensors(const Time& now, double period) {
    std::array<double, few_rays> few;
    const std::span<double> seen = seen_.empty() ? std::span(few).first(rays_) : std::span(seen_);
    // Rays that are not due keep their earlier values.
    if (due_.empty()) {
        read_ranges(seen);
    } else if (std::any_of(due_.begin(), due_.end(), [](std::uint8_t due) { return due != 0; })) {
        fresh_.resize(rays_);
        read_ranges(fresh_, due_);
        for (std::size_t i = 0; i < rays_; ++i) {
            if (due_[i] != 0) seen[i] = fresh_[i];
        }
    }
    measure_motion(now.tick, period);
    look_around(now.tick);
    std::size_t ray = 0;
    for (std::size_t i = 0; i < spec_.sensors.size(); ++i) {
        const SensorSpec& sensor = spec_.sensors[i];
        SensorReading& reading = readings_[i];
        reading.tm = now.seconds;
        const auto percent = [&](double light) {
            return std::clamp(with_noise({i, now.tick}, light, sensor.noise), 0.0, 100.0);
        };
        switch (sensor.kind) {
            case SensorSpec::Kind::button:
            case SensorSpec::Kind::touch: reading.value = is_pressed(i) ? 1 : 0; break;
            case SensorSpec::Kind::gyro: {
                const double turned = yaw_rate();
                const double felt =
                    sensor.max_rate > 0 ? std::clamp(turned, -sensor.max_rate, sensor.max_rate) : turned;
                const double rate = felt + sensor.drift;
                gyro_angle_ += rate * period;
                reading.physical = with_noise({i, now.tick, 1}, rate, 0);
                reading.value = with_noise({i, now.tick}, gyro_angle_, sensor.noise);
                break;
            }
            case SensorSpec::Kind::color: reading.value = static_cast<double>(floor_color(i)); break;
            case SensorSpec::Kind::reflect: reading.value = percent(reflected_light(i)); break;
            case SensorSpec::Kind::ambient: reading.value = percent(sensor.level); break;
            case SensorSpec::Kind::range: measure_range({i, now.tick}, seen[ray++], reading); break;
            case SensorSpec::Kind::scan:
                for (std::size_t part = 0; part < rays_of(sensor); ++part, ++ray) {
                    if (due_.empty() || due_[ray] != 0) seen[ray] = seen_by(sensor, {i, now.tick, part}, seen[ray]);
                }
                break;
            case SensorSpec::Kind::imu:
            case SensorSpec::Kind::neighbours: break;
        }
    }
    return readings_;
}

std::span<const double> SimulatedBody::sensor_values(std::size_t index) const {
    for (const Inertial& each : inertial_) {
        if (each.sensor == index) return each.values;
    }
    if (spec_.sensors[index].kind != SensorSpec::Kind::scan) return {};
    return std::span(seen_).subspan(first_ray(index), rays_of(spec_.sensors[index]));
}

std::size_t SimulatedBody::first_ray(std::size_t index) const {
    std::size_t first = 0;
    for (std::size_t i = 0; i < index; ++i) first += rays_of(spec_.sensors[i]);
    return first;
}

void SimulatedBody::set_due(std::size_t index, bool due) {
    for (Around& each : around_) {
        if (each.sensor != index) continue;
        each.is_due = due;
        return;
    }
    due_.resize(rays_, 1);
    const auto begin = due_.begin() + static_cast<std::ptrdiff_t>(first_ray(index));
    std::fill_n(begin, rays_of(spec_.sensors[index]), due ? 1 : 0);
}

double SimulatedBody::servo_angle(std::size_t index) const { return servos_[index].angle; }

void SimulatedBody::aim_servo(std::size_t index, double angle, double speed) {
    Servo& servo = servos_[index];
    const double most = spec_.actuators[index].max_rate;
    servo.wanted = angle;
    servo.speed = most > 0 && (speed <= 0 || speed > most) ? most : speed;
    servos_turn_ = true;
}

void SimulatedBody::turn_servos(double period) {
    if (!servos_turn_) return;
    servos_turn_ = false;
    for (std::size_t i = 0; i < servos_.size(); ++i) {
        Servo& servo = servos_[i];
        const double way = servo.wanted - servo.angle;
        if (way == 0) continue;
        const bool arrives = servo.speed <= 0 || std::abs(way) <= servo.speed * period;
        servo.angle = arrives ? servo.wanted : servo.angle + std::copysign(servo.speed * period, way);
        set_servo(i, servo.angle);
        servos_turn_ = servos_turn_ || !arrives;
    }
}

}  // namespace nezumi::sim
