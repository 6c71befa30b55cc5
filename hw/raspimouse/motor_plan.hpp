// Plans the writes that lead the mouse's motors and buzzer from one state to another.
#pragma once

#include <vector>

namespace nezumi::hw {

/// The values of the device files of motors and buzzer.
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

/// The state after this write.
MotorState after(const MotorState& state, const MotorWrite& write);

/// The nearest state that the hardware allows: no motion without power, and no tone in motion, because the buzzer
/// shares its PWM channel with the right motor.
MotorState possible(MotorState wanted);

/// Returns the writes, in order, from one state to another (`possible`) one. Only changes are written, because any
/// write to a motor silences the buzzer: a tone ends before the wheels start, and starts again after a write that
/// silenced it. Power is switched on before motion and off after it.
std::vector<MotorWrite> plan(const MotorState& is, const MotorState& wanted);

}  // namespace nezumi::hw
