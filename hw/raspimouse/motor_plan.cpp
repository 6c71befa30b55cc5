// The order of writes to the nodes of motors, power and buzzer.
#include "hw/raspimouse/motor_plan.hpp"

namespace nezumi::hw {

MotorState after(const MotorState& state, const MotorWrite& write) {
    using enum MotorWrite::Node;
    MotorState next = state;
    switch (write.node) {
        case power: next.power = write.value != 0; break;
        case left: next.left = write.value; break;
        case right: next.right = write.value; break;
        case buzzer: next.tone = write.value; break;
    }
    if (write.node == left || write.node == right) next.tone = 0;
    return next;
}

MotorState possible(MotorState wanted) {
    if (!wanted.power) wanted.left = wanted.right = 0;
    if (wanted.left != 0 || wanted.right != 0) wanted.tone = 0;
    return wanted;
}

std::vector<MotorWrite> plan(const MotorState& is, const MotorState& wanted) {
    using enum MotorWrite::Node;
    const MotorState goal = possible(wanted);
    std::vector<MotorWrite> writes;
    MotorState state = is;
    const auto write = [&](MotorWrite::Node node, int value) {
        writes.push_back({node, value});
        state = after(state, writes.back());
    };
    const bool motors_change = goal.left != state.left || goal.right != state.right;
    if (state.tone != 0 && (motors_change || goal.tone == 0)) write(buzzer, 0);
    if (goal.power && !state.power) write(power, 1);
    if (goal.left != state.left) write(left, goal.left);
    if (goal.right != state.right) write(right, goal.right);
    if (!goal.power && state.power) write(power, 0);
    if (goal.tone != state.tone) write(buzzer, goal.tone);
    return writes;
}

}  // namespace nezumi::hw
