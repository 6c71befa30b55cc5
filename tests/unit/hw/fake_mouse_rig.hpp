// The fake mouse, and a robot of the engine that uses it.
#pragma once

#include "hw/raspimouse/mouse_body.hpp"
#include "tests/unit/hw/fake_robot_rig.hpp"

namespace nezumi::hw {

inline std::string mouse_file() { return FakeRobot::robot_file("raspimouse"); }
inline RobotSpec mouse_spec() { return shipped_spec("raspimouse"); }

class FakeMouse : public FakeRobot {
public:
    explicit FakeMouse(const std::vector<std::string>& more = {}) : FakeRobot("fake_mouse", "raspimouse", more) {}

    std::string dev() const { return mount(); }
    DeviceRoots roots() const { return {.dev = dev(), .sys = folder.path("sys").string()}; }

    struct Motion {
        int left = 0, right = 0;  ///< [pulses/s]
        bool power = false;
        int tone = 0;
        double still_since = 0;  ///< [s] by `clock_seconds`; 0: it moves
        std::string leds;
    };
    Motion motion() {
        Motion now;
        std::istringstream(say("motion")) >> now.left >> now.right >> now.power >> now.tone >> now.still_since >>
            now.leds;
        return now;
    }
    bool moves() { return motion().still_since == 0; }
};

struct DrivenMouse : DrivenRobot {
    explicit DrivenMouse(FakeMouse& fake) : DrivenRobot(mouse_spec(), fake.roots()) {}
};

}  // namespace nezumi::hw
