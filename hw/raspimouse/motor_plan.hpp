// Which writes lead the mouse's motors and buzzer from what they do to what they are meant to do.
#pragma once

#include <vector>

namespace nezumi::hw {

/// What the nodes of motors and buzzer hold.
struct MotorState {
    bool power = false;
    int left = 0;   ///< [pulses/s], forward positive
    int right = 0;  ///< [pulses/s]
    int tone = 0;   ///< [Hz]; 0: silent

    bool operator==(const MotorState&) const = default;
};

struct MotorWrite {
    enum class Node { power, left, right, buzzer };
    Node node = Node::power;
    int value = 0;

    bool operator==(const MotorWrite&) const = default;
};

/// `state` once this has been written.
MotorState after(const MotorState& state, const MotorWrite& write);

/// `wanted` as the hardware can have it: without power nothing turns, and no tone in motion, as the buzzer shares its
/// PWM channel with the right motor.
MotorState possible(MotorState wanted);

/// The writes, in order, from one state to another, `possible` one. Only what changes is written, as any write to a
/// motor silences the buzzer: a tone ends before the wheels begin, and begins anew after a write that silenced it.
/// Power comes before motion and goes after it.
std::vector<MotorWrite> plan(const MotorState& is, const MotorState& wanted);

}  // namespace nezumi::hw
