// Finds the brick's sensors, keeps their modes and reads them.
#include "hw/ev3/sensors.hpp"

#include <fmt/format.h>

#include <cmath>

#include "engine/base/error.hpp"

namespace nezumi::hw {

using Access = Node::Access;

ModeSensor::Nodes::Nodes(const DevicePath& folder)
    : get_mode(folder + "/mode", Access::read),
      set_mode(folder + "/mode", Access::write),
      decimals(folder + "/decimals", Access::read),
      values{Node(folder + "/value0", Access::read), Node(folder + "/value1", Access::read),
             Node(folder + "/value2", Access::read)} {}

std::string ModeSensor::lost(const std::string& why) {
    nodes_.reset();
    return why;
}

// Checks the sensor's mode, and sets it if it differs: another program may have changed it, and with it the meaning of
// the values.
tl::expected<bool, std::string> ModeSensor::is_in_mode(double now) {
    const auto mode = nodes_->get_mode.read();
    if (!mode) return tl::unexpected(with_ev3_advice(mode.error()));
    if (mode->starts_with(mode_.mode) && mode->substr(mode_.mode.size()).find_first_not_of('\n') == mode->npos) {
        attempts_ = 0;
        return true;
    }
    const std::string is = fmt::format("'{}'", shown(mode->substr(0, mode->find('\n'))));
    settled_at_ = now + settling;
    scale_ = 0;
    const auto set = nodes_->set_mode.write(mode_.mode);
    if (++attempts_ < (set ? most_attempts : most_failures)) return false;
    if (!set) return tl::unexpected(with_ev3_advice(set.error()));
    return tl::unexpected(fmt::format("{}: expected {}, got {} again and again: does another program change it?",
                                      nodes_->get_mode.path(), mode_.mode, is));
}

tl::expected<std::optional<SensorValues>, std::string> ModeSensor::sample(double now) {
    if (nodes_ && now < settled_at_) return std::nullopt;  // not an error: the mode is still being changed
    if (!nodes_) {
        const auto folder = class_.find(mode_.driver, port_);
        if (!folder) return tl::unexpected(folder.error());
        nodes_.emplace(*folder);
        settled_at_ = now + settling;
        scale_ = 0;
        attempts_ = 0;
        ++plugged_in_;
    }
    const auto is_ready = is_in_mode(now);
    if (!is_ready) return tl::unexpected(lost(is_ready.error()));
    if (!*is_ready || now < settled_at_) return std::nullopt;
    if (scale_ == 0) {
        const auto decimals = read_whole_number(nodes_->decimals);
        if (!decimals) return tl::unexpected(lost(decimals.error()));
        scale_ = std::pow(10.0, -static_cast<double>(*decimals));
    }
    SensorValues sensed{.values = {}, .plugged_in = plugged_in_};
    for (std::size_t i = 0; i < mode_.values; ++i) {
        const auto value = read_whole_number(nodes_->values[i]);
        if (!value) return tl::unexpected(lost(value.error()));
        sensed.values[i] = static_cast<double>(*value) * scale_;
    }
    was_there_ = true;
    return sensed;
}

Battery::Battery(const DevicePath& folder)
    : Sampler("battery", 0.2),
      voltage_(folder + "/lego-ev3-battery/voltage_now", Access::read),
      design_(folder + "/lego-ev3-battery/voltage_min_design", Access::read) {}

double Battery::volts() const {
    return hangs(clock_seconds()) ? std::numeric_limits<double>::quiet_NaN() : volts_.load();
}

tl::expected<std::optional<double>, std::string> Battery::sample(double now) {
    const auto microvolts = read_whole_number(voltage_);
    if (!microvolts) {
        is_low_ = false;  // unknown
        volts_ = std::numeric_limits<double>::quiet_NaN();
        low_since_.reset();
        return tl::unexpected(microvolts.error());
    }
    const double volts = static_cast<double>(*microvolts) / 1e6;
    volts_ = volts;
    const auto design = read_whole_number(design_);
    const double lowest = design && *design > 0 ? static_cast<double>(*design) / 1e6 : least;
    if (volts >= lowest + (is_low_ ? margin : 0)) {
        low_since_.reset();
        is_low_ = false;
        return volts;
    }
    if (!low_since_) low_since_ = now;
    if (now - *low_since_ < low_after) return volts;
    is_low_ = true;
    return tl::unexpected(fmt::format(
        "is low, below {:.1f} V: the robot stands until the battery is charged or its cells are changed", lowest));
}

}  // namespace nezumi::hw
