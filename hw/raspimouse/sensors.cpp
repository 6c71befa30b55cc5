// Reads the mouse's sensors, and ignores wrong readings.
#include "hw/raspimouse/sensors.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <utility>

#include "hw/raspimouse/advice.hpp"

namespace nezumi::hw {
namespace {

using Access = Node::Access;

// [s] between readings. A reading takes at least 2.4 ms for the light sensors, up to 40 ms for a switch, 1.2 ms for a
// counter.
constexpr double light_period = 0.01;
constexpr double switch_period = 0.03;
constexpr double counter_period = 0.01;
// A counter is lost after this number of failed readings in a row.
constexpr int zeros_to_lose = 10;

}  // namespace

LightSensors::LightSensors(const DevicePath& folder)
    : Sampler("light sensors", light_period), node_(folder + "/rtlightsensor0", Access::read) {}

tl::expected<std::optional<LightValues>, std::string> LightSensors::sample(double /*now*/) {
    const auto text = node_.read();
    if (!text) return tl::unexpected(with_mouse_advice(text.error()));
    const auto values = decode_lights(*text);
    if (!values) return tl::unexpected(not_understood(node_, *text, "four numbers"));
    zeros_ = *values == LightValues{} ? zeros_ + 1 : 0;
    if (zeros_ >= zeros_to_doubt)
        return tl::unexpected(fmt::format(
            "{}: gives only 0 0 0 0: the SPI overlay is missing. Add {} to config.txt and start the robot again",
            node_.path(), light_sensor_overlay));
    return *values;
}

Switches::Switches(const DevicePath& folder)
    : Sampler("switches", switch_period),
      nodes_{Node(folder + "/rtswitch0", Access::read), Node(folder + "/rtswitch1", Access::read),
             Node(folder + "/rtswitch2", Access::read)} {}

tl::expected<std::optional<SwitchValues>, std::string> Switches::sample(double /*now*/) {
    SwitchValues values{};
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        const auto text = nodes_[i].read();
        if (!text) return tl::unexpected(with_mouse_advice(text.error()));
        const auto pressed = decode_switch(*text);
        if (!pressed) return tl::unexpected(not_understood(nodes_[i], *text, "0 or 1"));
        values[i] = *pressed;
    }
    return values;
}

WheelCounters::WheelCounters(const DevicePath& folder, std::shared_ptr<CommandedWheels> commanded)
    : Sampler("wheel counters", counter_period),
      commanded_(std::move(commanded)),
      left_(folder + "/rtcounter_l0"),
      right_(folder + "/rtcounter_r0") {}

tl::expected<PulseCounter::Verdict, std::string> WheelCounters::read(Wheel& wheel, const CommandedPulses& commanded) {
    using Verdict = PulseCounter::Verdict;
    const double before = clock_seconds();
    const auto text = wheel.node.read();
    const double tm = (before + clock_seconds()) / 2;
    if (!text) {
        const bool is_gone = text.error().code == ENODEV || text.error().code == ENOENT;
        if (is_gone) wheel.counter.begin_anew();
        if (is_gone && std::exchange(was_there_, false)) ++commanded_->driver_losses;
        // The motors' nodes exist, so the driver is loaded, but it has found no counters.
        if (text.error().code == ENOENT && !was_there_)
            return tl::unexpected(
                fmt::format("{}: the driver has not found them on I2C. {}", describe(text.error()), counters_on_i2c));
        return tl::unexpected(with_mouse_advice(text.error()));
    }
    const auto reading = decode_counter(*text);
    if (!reading) return tl::unexpected(not_understood(wheel.node, *text, "a number from 0 to 65535"));
    const Verdict verdict = wheel.counter.take(*reading, commanded.until(tm));
    // The program that opened the node last determines whether its numbers are signed. Opening it again corrects that.
    if (verdict == Verdict::jumped) wheel.node.close();
    if (verdict == Verdict::taken || verdict == Verdict::jumped) wheel.rate.take(tm, wheel.counter.pulses());
    return verdict;
}

tl::expected<std::optional<WheelValues>, std::string> WheelCounters::sample(double /*now*/) {
    using Verdict = PulseCounter::Verdict;
    const auto left = read(left_, commanded_->left);
    if (!left) return tl::unexpected(left.error());
    const auto right = read(right_, commanded_->right);
    if (!right) return tl::unexpected(right.error());
    was_there_ = true;  // only if both are there: one missing counter is one loss, even if the other can be read
    zeros_ = *left == Verdict::zero || *right == Verdict::zero ? zeros_ + 1 : 0;
    if (zeros_ >= zeros_to_lose)
        return tl::unexpected(fmt::format("they give 0 while the motors turn: I2C fails. {}", counters_on_i2c));
    const auto in_doubt = [](Verdict verdict) { return verdict == Verdict::zero || verdict == Verdict::doubted; };
    if (in_doubt(*left) || in_doubt(*right)) return std::nullopt;
    return WheelValues{.pulses = {.left = left_.counter.pulses(), .right = right_.counter.pulses()},
                       .rates = {.left = left_.rate.rate(), .right = right_.rate.rate()}};
}

}  // namespace nezumi::hw
