// A simulated robot's readings from true values: response curves, limits, noise, drift, pulses.
#include <catch2/catch.hpp>

#include <cmath>

#include "engine/ports/payload.hpp"
#include "sim/simulated_body.hpp"
#include "tests/unit/engine/fake_world.hpp"

using namespace nezumi;

namespace {

// Returns given values. Its spec is that of the fake mouse: a distance, a response, a gyro, a button.
struct Felt final : sim::SimulatedBody {
    explicit Felt(RobotSpec made = fake_mouse(), std::uint64_t seed = 1, double rate = 100)
        : Felt(std::make_unique<RobotSpec>(std::move(made)), seed, 1 / rate) {}
    Felt(std::unique_ptr<RobotSpec> made, std::uint64_t seed, double its_period)
        : SimulatedBody(*made, seed), period(its_period), spec(std::move(made)) {}

    RobotId id() const override { return 0; }
    Wheels wheel_angles() const override { return angles; }
    void read_ranges(std::span<double> distances, std::span<const std::uint8_t> due) const override {
        ++casts;
        asked.assign(due.begin(), due.end());
        for (std::size_t i = 0; i < distances.size(); ++i)
            distances[i] = i < ranges.size() ? ranges[i] : std::numeric_limits<double>::infinity();
    }
    bool is_pressed(std::size_t) const override { return pressed; }
    double yaw_rate() const override { return turns; }
    sim::PlaceMotion motion(std::size_t) const override { return moves; }
    FloorColor floor_color(std::size_t) const override { return FloorColor::red; }
    double reflected_light(std::size_t) const override { return light; }
    void list_neighbours(std::size_t, std::vector<InSight>&) const override {}
    void set_servo(std::size_t, double angle) override { servo_angles.push_back(angle); }
    void set_wheel_speeds(Wheels) override {}
    void coast() override {}

    std::vector<SensorReading> tick() {
        const Time now{ticks, static_cast<double>(ticks) * period};
        ++ticks;
        wheels = read_wheels(now, period);
        const auto all = read_sensors(now, period);
        return {all.begin(), all.end()};
    }

    double period;
    std::unique_ptr<RobotSpec> spec;
    std::int64_t ticks = 0;
    WheelReading wheels;
    Wheels angles;
    std::vector<double> ranges;
    bool pressed = false;
    double turns = 0, light = 0;
    sim::PlaceMotion moves;
    std::vector<double> servo_angles;
    mutable int casts = 0;  // of rays
    mutable std::vector<std::uint8_t> asked;
};

constexpr std::size_t metre = 0, response = 1, gyro = 2, button = 3;

}  // namespace

TEST_CASE("without an obstacle a value is that of its table and a distance its maximum", "[sim][sensor][fault]") {
    Felt body;
    const auto all = body.tick();
    CHECK(all[response].value == 0);  // and not -1978
    CHECK(all[response].physical == 0.6);
    CHECK(all[metre].value == 0.6);
    CHECK(all[metre].physical == 0.6);
    for (const SensorReading& each : all) CHECK(each.is_there);
}

TEST_CASE("distances stay within what the sensor can measure", "[sim][sensor]") {
    Felt body;
    const auto seen = [&](double first, double second) {
        body.ranges = {first, second};
        const auto all = body.tick();
        return std::vector<double>{all[metre].value, all[response].physical, all[response].value};
    };
    CHECK(seen(0.2, 0.3) == std::vector<double>{0.2, 0.3, 100});
    CHECK(seen(0.001, 0.7) == std::vector<double>{0.03, 0.6, 0});
    CHECK(seen(0.6, 0.001) == std::vector<double>{0.6, 0.03, 4095});
}

TEST_CASE("noise stays within a sensor's range, has mean 0 and depends on the seed", "[sim][sensor]") {
    RobotSpec spec = fake_mouse();
    for (SensorSpec& sensor : spec.sensors) {
        if (sensor.kind == SensorSpec::Kind::range) sensor.noise = sensor.has_response ? 50 : 0.05;
    }
    const auto values = [&](std::uint64_t seed, std::vector<double> distances) {
        Felt body(spec, seed);
        body.ranges = std::move(distances);
        std::vector<double> all;
        for (int i = 0; i < 2000; ++i) {
            const auto readings = body.tick();
            all.push_back(readings[metre].physical);
            all.push_back(readings[response].value);
            REQUIRE(readings[response].value >= 0);
            REQUIRE(readings[response].value <= 4095);
            REQUIRE(readings[metre].physical >= 0.03);
            REQUIRE(readings[metre].physical <= 0.6);
        }
        return all;
    };
    const std::vector<double> once = values(7, {0.3, 0.2});
    CHECK(once == values(7, {0.3, 0.2}));
    CHECK(once != values(8, {0.3, 0.2}));
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < once.size(); i += 2) {
        sum += once[i] - 0.3;
        squares += (once[i] - 0.3) * (once[i] - 0.3);
    }
    CHECK(std::abs(sum / 2000) < 0.005);
    CHECK(std::sqrt(squares / 2000) == Approx(0.05).epsilon(0.1));
    values(7, {0.031, 0.001});  // at the edges of both
    values(7, {});
}

TEST_CASE("the noise of a robot is relative to each value of its sensors", "[sim][sensor]") {
    RobotSpec spec = fake_mouse();
    spec.noise = 0.05;
    Felt body(spec);
    body.ranges = {0.3, 0.2};
    body.pressed = true;
    body.turns = 1;
    const ResponseTable& table = body.spec->sensors[response].response;
    double distances = 0, values = 0, rates = 0;
    for (int i = 0; i < 2000; ++i) {
        const auto all = body.tick();
        distances += std::pow(all[metre].value / 0.3 - 1, 2);
        values += std::pow(all[response].value / table(0.2) - 1, 2);
        rates += std::pow(all[gyro].physical - 1, 2);
        // The distance follows from the noisy value, as with a real sensor.
        REQUIRE(all[response].physical == distance_at(table, all[response].value));
        REQUIRE(all[button].value == 1);
    }
    CHECK(std::sqrt(distances / 2000) == Approx(0.05).epsilon(0.1));
    CHECK(std::sqrt(values / 2000) == Approx(0.05).epsilon(0.1));
    CHECK(std::sqrt(rates / 2000) == Approx(0.05).epsilon(0.1));
    body.ranges = {};
    for (int i = 0; i < 100; ++i) REQUIRE(body.tick()[metre].value == 0.6);
}

TEST_CASE("the noise of a robot is added to that of its sensors", "[sim][sensor]") {
    RobotSpec spec = fake_mouse();
    spec.noise = 0.1;  // of 0.3 m: 0.03 m
    spec.sensors[metre].noise = 0.04;
    Felt body(spec);
    body.ranges = {0.3};
    double squares = 0;
    for (int i = 0; i < 2000; ++i) squares += std::pow(body.tick()[metre].value - 0.3, 2);
    CHECK(std::sqrt(squares / 2000) == Approx(0.05).epsilon(0.1));
}

TEST_CASE("a distance beyond the range has no noise", "[sim][sensor]") {
    RobotSpec spec = fake_mouse();
    spec.sensors[metre].noise = 0.05;
    Felt body(spec);
    for (int i = 0; i < 100; ++i) REQUIRE(body.tick()[metre].physical == 0.6);
}

TEST_CASE("a gyro integrates the yaw rate, limited to its largest rate", "[sim][sensor]") {
    for (const double rate : {100.0, 50.0}) {
        Felt body(fake_mouse(), 1, rate);
        const auto after_a_second = [&](double turns) {
            body.turns = turns;
            for (int i = 1; i < static_cast<int>(rate); ++i) body.tick();
            return body.tick()[gyro];
        };
        CHECK(after_a_second(0.5).value == Approx(0.5));
        const SensorReading fast = after_a_second(-9);
        CHECK(fast.value == Approx(0.5 - 2));
        CHECK(fast.physical == -2);
    }
    RobotSpec drifting = fake_mouse();
    drifting.sensors[gyro].drift = 0.01;
    Felt body(drifting);
    for (int i = 0; i < 99; ++i) body.tick();
    const SensorReading drifted = body.tick()[gyro];
    CHECK(drifted.value == Approx(0.01));
    CHECK(drifted.physical == 0.01);
}

TEST_CASE("light stays between 0 and 100 with any noise", "[sim][sensor]") {
    for (const auto kind : {SensorSpec::Kind::reflect, SensorSpec::Kind::ambient}) {
        RobotSpec spec = fake_mouse();
        for (const double light : {0.0, 100.0}) {
            spec.sensors[button].kind = kind;
            spec.sensors[button].noise = 5;
            spec.sensors[button].level = light;
            Felt body(spec);
            body.light = light;
            bool differs = false;
            for (int i = 0; i < 200; ++i) {
                const double value = body.tick()[button].value;
                REQUIRE(value >= 0);
                REQUIRE(value <= 100);
                differs = differs || value != light;
            }
            CHECK(differs);
        }
    }
}

TEST_CASE("encoders count whole pulses without losing any", "[sim][sensor]") {
    RobotSpec spec = fake_mouse();
    spec.drive.pulses_per_turn = 400;
    Felt body(spec);
    const double pulse = 2 * M_PI / 400;
    const auto counted = [&](double left, double right) {
        body.angles = {left * pulse, right * pulse};
        body.tick();
        return body.wheels.pulses;
    };
    CHECK(counted(0.4, -0.4) == WheelPulses{0, 0});
    CHECK(counted(0.8, -0.8) == WheelPulses{1, -1});
    for (int i = 0; i <= 4000; ++i) counted(0.1 * i, 0.1 * i);
    CHECK(body.wheels.pulses == WheelPulses{400, 400});
    // The speed of the rims is known more exactly.
    counted(400.5, 400.25);
    CHECK(body.wheels.speeds.left == Approx(0.5 * pulse * 0.02 * 100));
    CHECK(body.wheels.speeds.right == Approx(0.25 * pulse * 0.02 * 100));
}

TEST_CASE("a servo moves no faster than its command and its limit", "[sim][robot]") {
    RobotSpec spec = fake_mouse();
    spec.actuators[2].max_rate = 2;
    for (const auto& [speed, expected] : {std::pair{0.0, 0.02}, {1.0, 0.01}, {50.0, 0.02}}) {
        Felt body(spec);
        body.aim_servo(2, 0.05, speed);
        body.tick();
        CHECK(body.servo_angle(2) == Approx(expected));
        for (int i = 0; i < 5; ++i) body.tick();
        CHECK(body.servo_angle(2) == 0.05);
        CHECK(body.servo_angles.back() == 0.05);
        const std::size_t turned = body.servo_angles.size();
        body.tick();
        CHECK(body.servo_angles.size() == turned);
    }
}

TEST_CASE("each ray of a scan has a distance and noise of its own", "[sim][sensor]") {
    RobotSpec spec = fake_mouse();
    SensorSpec& scan = spec.sensors[metre];
    scan.kind = SensorSpec::Kind::scan;
    scan.cone = 1;
    scan.rays = 3;
    scan.noise = 0.01;
    Felt body(spec);
    body.ranges = {0.2, 0.4, 9, 0.3};  // three of the scan, then the response
    std::vector<double> sums(2), products(1);
    for (int i = 0; i < 2000; ++i) {
        const auto all = body.tick();
        const auto values = body.sensor_values(metre);
        REQUIRE(values.size() == 3);
        REQUIRE(values[2] == 0.6);  // nothing in sight
        REQUIRE(all[response].value == 100);
        const double first = values[0] - 0.2, second = values[1] - 0.4;
        sums[0] += first * first;
        sums[1] += second * second;
        products[0] += first * second;
    }
    CHECK(std::sqrt(sums[0] / 2000) == Approx(0.01).epsilon(0.1));
    CHECK(std::sqrt(sums[1] / 2000) == Approx(0.01).epsilon(0.1));
    CHECK(std::abs(products[0] / 2000) < 1e-5);  // independent
}

TEST_CASE("an imu measures rates and the supporting acceleration in its own frame", "[sim][sensor]") {
    RobotSpec spec = fake_mouse();
    spec.sensors[button].kind = SensorSpec::Kind::imu;
    spec.sensors[button].max_rate = 2;
    Felt body(spec);
    body.moves.axes = {{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}};  // it looks along the world's y axis
    body.moves.spin = {0.5, 0, 3};
    const auto felt = [&] {
        body.tick();
        const auto values = body.sensor_values(button);
        return std::vector<double>(values.begin(), values.end());
    };
    CHECK(felt() == std::vector<double>{0, -0.5, 2, 0, 0, 9.81});
    body.moves.velocity = {0, 0.01, 0};  // 1 m/s2 ahead
    CHECK(felt()[3] == Approx(1));
    CHECK(felt()[3] == Approx(0).margin(1e-12));
}

TEST_CASE("rates and accelerations of an imu have noise of their own size", "[sim][sensor]") {
    RobotSpec spec = fake_mouse();
    spec.sensors[button].kind = SensorSpec::Kind::imu;
    spec.sensors[button].noise = 0.01;
    spec.sensors[button].acceleration_noise = 0.2;
    Felt body(spec);
    std::vector<double> squares(6);
    for (int i = 0; i < 2000; ++i) {
        body.tick();
        const auto values = body.sensor_values(button);
        for (std::size_t k = 0; k < 6; ++k) squares[k] += std::pow(values[k] - (k == 5 ? 9.81 : 0), 2);
    }
    for (std::size_t k = 0; k < 6; ++k) CHECK(std::sqrt(squares[k] / 2000) == Approx(k < 3 ? 0.01 : 0.2).epsilon(0.1));
}

TEST_CASE("the rays of a scan without readers are not cast", "[sim][sensor]") {
    RobotSpec spec = fake_mouse();
    SensorSpec& scan = spec.sensors[metre];
    scan.kind = SensorSpec::Kind::scan;
    scan.cone = 1;
    scan.rays = 3;
    Felt body(spec);
    body.ranges = {0.2, 0.4, 0.5, 0.3};
    body.tick();
    CHECK(body.asked.empty());  // all
    body.set_due(metre, false);
    body.ranges = {0.1, 0.1, 0.1, 0.25};
    CHECK(body.tick()[response].physical == 0.25);
    CHECK(body.asked == std::vector<std::uint8_t>{0, 0, 0, 1});
    CHECK(body.sensor_values(metre)[1] == 0.4);  // as it was
    body.set_due(metre, true);
    body.tick();
    CHECK(body.sensor_values(metre)[1] == 0.1);
}
