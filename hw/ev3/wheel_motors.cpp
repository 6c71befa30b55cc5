// Writes a wheel's command when it changes, and repeats it before the kernel would stop the motor, as long as the
// control loop wants it.
#include "hw/ev3/wheel_motors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "hw/device/clock.hpp"

namespace nezumi::hw {
namespace {

constexpr double attention = 0.05;                       // [s] between readings if the thread is not woken
constexpr double tell_again = TachoMotor::dead_man / 2;  // [s]

}  // namespace

Expected<std::unique_ptr<WheelMotors>> WheelMotors::make(const DevicePath& folder,
                                                         const std::array<std::string, count>& ports,
                                                         double acceleration) {
    std::unique_ptr<WheelMotors> motors(new WheelMotors(folder, ports, acceleration));
    // Finds both motors before it writes: if one is missing, nothing is changed.
    for (Wheel& wheel : motors->wheels_) {
        if (auto ok = wheel.motor.find(); !ok) return failure("motors: " + ok.error());
    }
    auto guard = Guard::start("ev3", folder);
    if (!guard) return Unexpected(guard.error());
    motors->guard_ = std::make_unique<GuardWatch>(std::move(*guard));
    if (auto ok = motors->prepare(); !ok) return failure("motors: " + ok.error());
    return motors;
}

tl::expected<void, std::string> WheelMotors::prepare() {
    for (Wheel& wheel : wheels_) {
        wheel.mode = Wheel::Mode::unknown;
        if (!wheel.motor.is_found()) {
            if (auto ok = wheel.motor.find(); !ok) return ok;
        }
    }
    for (std::size_t i = 0; i < count; ++i) {
        TachoMotor& motor = wheels_[i].motor;
        const auto ok =
            guard_->take_up(motor.command_node(), {.index = i, .text = "stop", .proof = Proof::empty_write});
        if (!ok) return tl::unexpected(motor.give_up(with_ev3_advice(ok.error())));
    }
    for (Wheel& wheel : wheels_) {
        if (auto ok = wheel.motor.prepare(); !ok) return ok;
        wheel.mode = Wheel::Mode::coast;
    }
    return {};
}

std::optional<Sample<WheelValues>> WheelMotors::newest(double now) {
    if (hangs(now)) health_.lost(no_answer);
    return sample_.at(now);
}

std::vector<std::string> WheelMotors::take_faults() {
    std::vector<std::string> all = health_.take();
    append(all, stalls_.take());
    append(all, guard_->take_faults());
    return all;
}

bool WheelMotors::turns() const { return wheels_[0].mode == Wheel::Mode::run || wheels_[1].mode == Wheel::Mode::run; }

// Stops each motor separately: if one fails, the other must still stop.
void WheelMotors::stop_all() {
    for (Wheel& wheel : wheels_) {
        wheel.mode = Wheel::Mode::unknown;
        if (!wheel.motor.is_found()) continue;
        if (const auto ok = wheel.motor.hold(); ok) {
            wheel.mode = Wheel::Mode::hold;
        } else {
            health_.lost(ok.error());
        }
    }
    guard_->rest();
}

void WheelMotors::lose(const NodeError& trouble) {
    for (Wheel& wheel : wheels_) {
        const bool is_its = wheel.motor.is_found() && wheel.motor.command_node().path() == trouble.path;
        if (is_its) health_.lost(wheel.motor.give_up(with_ev3_advice(trouble)));
    }
    stop_all();
}

bool WheelMotors::has_to_stop(double now, bool they_turn) {
    if (!guard_->must_stop(now, they_turn)) return false;
    stop_all();
    return true;
}

// From standstill, or after an unexpected stop, a wheel accelerates within the robot's limits.
double WheelMotors::reachable(const Wheel& wheel, double rate, double elapsed) const {
    // Ticks are slightly irregular. After a gap the speed must not jump.
    constexpr double unevenness = 1.5, longest_gap = 0.1;
    if (!std::isfinite(rate)) return 0;
    const double held = wheel.mode == Wheel::Mode::run ? wheel.commanded_rate : 0;
    const double most = (held * rate > 0 ? std::abs(held) : 0) +
                        std::max(1.0, acceleration_ * unevenness * std::clamp(elapsed, 0.0, longest_gap));
    return std::clamp(rate, -most, most);
}

tl::expected<void, std::string> WheelMotors::tell(Wheel& wheel, const Command& command, double rate, double now) {
    using Mode = Wheel::Mode;
    const int whole = static_cast<int>(std::lround(rate));
    const Mode wanted = !command.drives ? Mode::coast : whole == 0 ? Mode::hold : Mode::run;
    if (wanted == wheel.mode &&
        (wanted != Mode::run || (whole == wheel.commanded_rate && now - wheel.commanded_at < tell_again)))
        return {};
    wheel.mode = Mode::unknown;
    auto ok = wanted == Mode::coast  ? wheel.motor.coast()
              : wanted == Mode::hold ? wheel.motor.hold()
                                     : wheel.motor.run(whole);
    if (!ok) return ok;
    wheel.mode = wanted;
    wheel.commanded_rate = whole;
    wheel.commanded_at = now;
    return {};
}

tl::expected<void, std::string> WheelMotors::perform(const Command& command, double now) {
    const double elapsed = now - std::exchange(served_at_, now);
    const std::array rates{command.rates.left, command.rates.right};
    // While this thread was suspended, the guard may have stopped the motors or been suspended too. Then the command is
    // no longer valid.
    const auto is_void = [&] { return has_to_stop(clock_seconds(), turns() || (rates[0] != 0 || rates[1] != 0)); };
    for (std::size_t i = 0; i < count && !is_void(); ++i) {
        Wheel& wheel = wheels_[i];
        if (auto ok = tell(wheel, command, reachable(wheel, rates[i], elapsed), now); !ok) return ok;
    }
    is_void();
    return {};
}

tl::expected<void, std::string> WheelMotors::read_positions() {
    std::array<std::int64_t, 2> pulses{};
    double tm = 0;
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
        const double before = clock_seconds();
        const auto position = wheels_[i].motor.position();
        if (!position) return tl::unexpected(position.error());
        const double read_at = (before + clock_seconds()) / 2;
        pulses[i] = *position;
        wheels_[i].rate.take(read_at, *position);
        tm += read_at / 2;
    }
    sample_.put({.value = {.pulses = {.left = pulses[0], .right = pulses[1]},
                           .rates = {.left = wheels_[0].rate.rate(), .right = wheels_[1].rate.rate()}},
                 .tm = tm});
    return {};
}

// Reports stalled motors. They keep their commands, because the obstacle may go away.
void WheelMotors::look_for_stalls(double now) {
    constexpr double period = 0.1;  // [s]
    if (now - looked_at_ < period) return;
    looked_at_ = now;
    std::vector<std::string_view> ports;
    for (Wheel& wheel : wheels_) {
        if (wheel.motor.is_stalled()) ports.emplace_back(wheel.motor.port());
    }
    is_stalled_ = !ports.empty();
    if (ports.empty()) {
        stalls_.works();
    } else {
        stalls_.lost(fmt::format("{} stalled: full power, but the speed is not reached: is a wheel blocked?",
                                 fmt::join(ports, " and ")));
    }
}

double WheelMotors::run() {
    const double now = clock_seconds();
    has_to_stop(now, turns());
    if (guard_->trouble() && !health_.is_lost()) lose(*guard_->trouble());
    if (health_.is_lost()) {
        if (now < retry_at_) return retry_at_ - now;
        retry_at_ = now + retry_period;
        // If its encoder can't be read, a motor must not turn at all.
        if (!prepare() || !read_positions()) {
            stop_all();
            return retry_period;
        }
        health_.works();
    }
    auto [command, is_new] = newest_.take();
    if (is_new) wants_to_turn_ = command.drives && (command.rates.left != 0 || command.rates.right != 0);
    if (wants_to_turn_ && !guard_->may_turn(now)) command.rates = {};
    auto ok = is_new ? perform(command, now) : tl::expected<void, std::string>();
    if (ok && health_.is_lost()) return attention;  // it failed while it was being stopped
    if (ok) ok = read_positions();
    if (!ok) {
        health_.lost(ok.error());
        stop_all();
        retry_at_ = clock_seconds() + retry_period;
        return retry_period;
    }
    look_for_stalls(now);
    if (!wants_to_turn_) {
        guard_->rest();
    } else if (is_new) {
        guard_->beat();
    }
    return attention;
}

// Wheels that stand are released, so a person can roll the robot.
void WheelMotors::end() {
    const bool turned = turns();
    stop_all();
    if (turned) return;
    for (Wheel& wheel : wheels_) {
        if (wheel.motor.is_found()) static_cast<void>(wheel.motor.coast());
    }
}

}  // namespace nezumi::hw
