// The fake EV3, and a robot of the engine that uses it.
#pragma once

#include "hw/ev3/ev3_body.hpp"
#include "tests/unit/hw/fake_robot_rig.hpp"

namespace nezumi::hw {

inline RobotSpec ev3_spec() { return shipped_spec("ev3"); }

class FakeEv3 : public FakeRobot {
public:
    explicit FakeEv3(const std::vector<std::string>& more = {}) : FakeRobot("fake_ev3", "ev3", more) {}

    DeviceRoots roots() const { return {.dev = mount() + "/dev", .sys = mount() + "/sys"}; }

    struct Motion {
        int left = 0, right = 0;  ///< [pulses/s]
        bool rolls = false;
        double still_since = 0;  ///< [s] by `clock_seconds`; 0: it moves
        std::string leds;
    };
    Motion motion() {
        Motion now;
        std::istringstream(say("motion")) >> now.left >> now.right >> now.rolls >> now.still_since >> now.leds;
        return now;
    }
    bool moves() { return motion().still_since == 0; }
};

struct DrivenEv3 : DrivenRobot {
    explicit DrivenEv3(FakeEv3& fake) : DrivenRobot(ev3_spec(), fake.roots()) {}
};

}  // namespace nezumi::hw
