// A component whose hooks a test writes, for the tests of engine/.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/components/component.hpp"

namespace nezumi {

/// Ports `in`, `queue`, `out`, `speed` and `tone`; every hook notes its name and does what the test gave it.
class TryComponent : public Component {
public:
    using Hooked = std::function<Expected<void>(TryComponent&)>;

    explicit TryComponent(std::string name = "it") : Component(std::move(name), "Try") {
        set_log(
            [this](const LogLine& line) { log_lines.push_back(std::string(to_text(line.level)) + ": " + line.text); });
    }

    InPort<std::int32_t>& in = add_in_port<std::int32_t>("in");
    InPort<std::int32_t>& queue = add_in_port<std::int32_t>("queue", "", 2);
    OutPort<std::int32_t>& out = add_out_port<std::int32_t>("out");
    OutPort<Velocity2D>& speed = add_out_port<Velocity2D>("speed");
    OutPort<std::int16_t>& tone = add_out_port<std::int16_t>("tone");

    Hooked activated, executed, deactivated, aborting, error, reset_hook;
    std::vector<std::string> hooks;
    std::vector<std::string> log_lines;

private:
    Expected<void> call(const Hooked& hooked) {
        hooks.emplace_back(to_text(hook()));
        return hooked ? hooked(*this) : Expected<void>{};
    }
    Expected<void> on_activated() override { return call(activated); }
    Expected<void> on_execute() override { return call(executed); }
    Expected<void> on_deactivated() override { return call(deactivated); }
    Expected<void> on_aborting() override { return call(aborting); }
    Expected<void> on_error() override { return call(error); }
    Expected<void> on_reset() override { return call(reset_hook); }
};

}  // namespace nezumi
