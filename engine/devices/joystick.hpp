// An on-screen joystick: where its stick is, published at its rate whether or not it moved.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/components/component.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

class System;

/// Who sends to its in-port `stick` holds the stick: a prompt's arrow keys, a browser's pad, another component. When
/// nothing has come since it was read last, it is back in the middle. The pad is 300 x 300 px.
class Joystick final : public Device {
public:
    explicit Joystick(std::string name);

    static constexpr float edge = 150;  ///< [px] from the middle of the pad

    void sense(const Time& now) override;
    void actuate(const Time& /*now*/) override {}

private:
    InPort<std::vector<float>>& stick_;  // {x, y} [px] from the middle, y up
    OutPort<std::vector<float>>& pos_;   // {x, y} [px] from the middle, y up
    OutPort<std::vector<float>>& vel_;   // {left, right} wheel, the stick turned by 45 degrees
};

/// The maker of components of type Joystick.
Expected<std::unique_ptr<Component>> make_joystick(const ComponentEntry& entry, System& system);

}  // namespace nezumi
