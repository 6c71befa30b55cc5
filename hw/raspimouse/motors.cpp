// Every command sends a beat to the guard: if the control loop or a device hangs, beats are missing, and the guard
// stops the motors.
#include "hw/raspimouse/motors.hpp"

#include <array>
#include <utility>

#include "hw/device/clock.hpp"
#include "hw/device/sampler.hpp"
#include "hw/raspimouse/advice.hpp"
#include "hw/raspimouse/codec.hpp"

namespace nezumi::hw {
namespace {

constexpr double idle = 1;            // [s] between checks while there is nothing to do
constexpr double power_check = 0.05;  // [s] between checks while the motors have power

}  // namespace

Motors::Motors(const DevicePath& folder, std::unique_ptr<Guard> guard, Wheels metres_per_pulse, double acceleration,
               double standing_power)
    : guard_(std::move(guard)),
      power_(folder + "/rtmotoren0", Node::Access::write),
      left_(folder + "/rtmotor_raw_l0", Node::Access::write),
      right_(folder + "/rtmotor_raw_r0", Node::Access::write),
      buzzer_(folder + "/rtbuzzer0", Node::Access::write),
      left_rate_(metres_per_pulse.left, acceleration),
      right_rate_(metres_per_pulse.right, acceleration),
      standing_power_(standing_power) {}

Expected<std::unique_ptr<Motors>> Motors::make(const DevicePath& folder, Wheels metres_per_pulse, double acceleration,
                                               double standing_power) {
    const DevicePath power = folder + "/rtmotoren0", left = folder + "/rtmotor_raw_l0",
                     right = folder + "/rtmotor_raw_r0";
    // Checks all nodes before it writes: if one is missing, nothing is changed.
    for (const DevicePath& path : {power, left, right}) {
        if (auto ok = Node(path, Node::Access::write).open(); !ok)
            return failure("motors: " + with_mouse_advice(ok.error()));
    }
    auto guard = Guard::start("raspimouse", power);
    if (!guard) return Unexpected(guard.error());
    std::unique_ptr<Motors> motors(
        new Motors(folder, std::move(*guard), metres_per_pulse, acceleration, standing_power));
    auto ok = motors->be_guarded();
    if (ok) ok = motors->stop_all();
    if (!ok) return failure("motors: " + with_mouse_advice(ok.error()));
    return motors;
}

std::vector<std::string> Motors::take_faults() {
    if (hangs(clock_seconds())) health_.lost(no_answer);
    std::vector<std::string> all = health_.take();
    append(all, buzzer_health_.take());
    append(all, guard_.take_faults());
    return all;
}

int Motors::watched_file() const { return guard_.file(); }

void Motors::follow(const MotorState& state) {
    const double now = clock_seconds();
    if (state.left != state_.left) commanded_->left.set_rate(state.left, now);
    if (state.right != state_.right) commanded_->right.set_rate(state.right, now);
    state_ = state;
}

tl::expected<void, NodeError> Motors::stop_all() {
    const auto power = power_.write(encode_switch(false));
    if (power) guard_.rest();  // without power there is no motion
    const auto left = left_.write(encode_number(0)), right = right_.write(encode_number(0));
    if (left && right) guard_.rest();  // without pulses there is no motion
    forget();
    for (const auto* each : {&power, &left, &right}) {
        if (!*each) return *each;
    }
    return {};
}

// Gives the guard the nodes. Only the power's node is proved by an empty write, because without power there is no
// motion, and the kernel's driver logs a message for each empty write to a motor's node.
tl::expected<void, NodeError> Motors::be_guarded() {
    const std::array nodes{&power_, &left_, &right_};
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const bool is_power = i == 0;
        auto ok = nodes[i]->open();
        if (ok)
            ok = guard_.take_up(*nodes[i], {.index = i,
                                            .text = is_power ? encode_switch(false) : encode_number(0),
                                            .proof = is_power ? Proof::empty_write : Proof::is_there});
        if (ok) continue;
        for (Node* node : nodes) node->close();  // their paths may now lead to other files
        return ok;
    }
    return {};
}

void Motors::reopen(const std::string& why) {
    health_.lost(why);
    static_cast<void>(stop_all());  // through descriptors that are still open
    for (Node* node : {&power_, &left_, &right_, &buzzer_}) node->close();
}

bool Motors::has_to_stop(double now, bool they_turn) {
    if (!guard_.must_stop(now, they_turn)) return false;
    static_cast<void>(stop_all());
    return true;
}

// Forgets the last command, because the motors were stopped: it must not start them again.
void Motors::forget() {
    follow({});
    goal_ = {};
    wants_power_ = false;
}

MotorState Motors::wanted(const MotorCommand& command, bool is_new, double now) {
    MotorState goal = goal_;
    if (is_new) {
        const double elapsed = now - std::exchange(served_at_, now);
        goal.left = left_rate_.next(command.speeds.left, state_.left, elapsed);
        goal.right = right_rate_.next(command.speeds.right, state_.right, elapsed);
        goal.tone = command.tone;
        if (goal.left != 0 || goal.right != 0 || !std::exchange(has_power_command_, command.power)) moved_at_ = now;
        goal.power = command.power;
    }
    goal_ = goal;
    wants_power_ = goal.power && now - moved_at_ < standing_power_;
    goal.power = wants_power_ && guard_.may_turn(now);
    return possible(goal);
}

bool Motors::write(const MotorWrite& write) {
    switch (write.node) {
        case MotorWrite::Node::buzzer: {
            // A robot without its buzzer can still drive.
            const auto ok = buzzer_.write(encode_number(write.value));
            if (ok) {
                buzzer_health_.works();
            } else {
                buzzer_health_.lost(with_mouse_advice(ok.error()));
            }
            break;
        }
        case MotorWrite::Node::power:
        case MotorWrite::Node::left:
        case MotorWrite::Node::right: {
            const bool is_power = write.node == MotorWrite::Node::power;
            Node& node = is_power ? power_ : write.node == MotorWrite::Node::left ? left_ : right_;
            const auto ok = node.write(is_power ? encode_switch(write.value != 0) : encode_number(write.value));
            if (ok) break;
            health_.lost(with_mouse_advice(ok.error()));
            return false;
        }
    }
    follow(after(state_, write));
    return true;
}

bool Motors::perform(const MotorState& goal) {
    // While this thread was suspended, the guard may have stopped the motors or been suspended too. Then the goal is no
    // longer valid.
    const auto is_void = [&] { return has_to_stop(clock_seconds(), goal.power); };
    for (const MotorWrite& each : plan(state_, goal)) {
        if (is_void()) return true;
        if (!write(each)) return false;
    }
    is_void();
    return true;
}

double Motors::run() {
    const double now = clock_seconds();
    has_to_stop(now, state_.power);
    if (guard_.trouble() && !health_.is_lost()) reopen(with_mouse_advice(*guard_.trouble()));
    if (const int losses = commanded_->driver_losses; std::exchange(driver_losses_, losses) != losses)
        reopen(
            "the driver's nodes have gone: the driver was reloaded or unloaded. The robot stands until they are back");
    if (health_.is_lost()) {
        if (now < retry_at_) return retry_at_ - now;
        retry_at_ = now + retry_period;
        if (!stop_all() || !be_guarded()) return retry_period;
        health_.works();
    }
    const auto [command, is_new] = newest_.take();
    if (!perform(wanted(command, is_new, now))) {
        static_cast<void>(stop_all());
        retry_at_ = clock_seconds() + retry_period;
        return retry_period;
    }
    if (!wants_power_) {
        guard_.rest();
    } else if (is_new) {
        guard_.beat();
    }
    return state_.power ? power_check : idle;
}

void Motors::end() {
    // Each motor is stopped separately: if one fails, the other must still stop. The guard then stops them again.
    static_cast<void>(stop_all());
    if (state_.tone != 0) static_cast<void>(buzzer_.write(encode_number(0)));
}

}  // namespace nezumi::hw
