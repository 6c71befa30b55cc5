// What each mode says, in the units that the sensors have.
#include "tests/fakes/ev3_sensor.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace nezumi::fakes {
namespace {

std::vector<std::string> modes_of(const std::string& driver) {
    if (driver == "lego-ev3-us") return {"US-DIST-CM", "US-DIST-IN", "US-LISTEN"};
    if (driver == "lego-ev3-gyro") return {"GYRO-ANG", "GYRO-RATE", "GYRO-G&A"};
    if (driver == "lego-ev3-color") return {"COL-REFLECT", "COL-AMBIENT", "COL-COLOR", "RGB-RAW"};
    return {"TOUCH"};
}

// Clockwise, as the gyro counts; 16 bits.
int degrees(double angle) { return static_cast<std::int16_t>(-std::lround(angle * 180 / std::numbers::pi)); }

}  // namespace

Ev3Sensor::Ev3Sensor(std::string driver, std::size_t channel)
    : driver_(std::move(driver)), channel_(channel), modes_(modes_of(driver_)), mode_(modes_.front()), before_(mode_) {}

int Ev3Sensor::set_mode(std::string_view mode, double now) {
    if (!mode.empty() && mode.back() == '\n') mode.remove_suffix(1);
    if (std::find(modes_.begin(), modes_.end(), mode) == modes_.end()) return -EINVAL;
    before_ = mode_;
    mode_ = mode;
    changed_at_ = now;
    return 0;
}

void Ev3Sensor::plug_in(const Ev3Surroundings& around) {
    mode_ = before_ = modes_.front();
    zero_ = around.angle;
}

std::vector<int> Ev3Sensor::values(const std::string& mode, const Ev3Surroundings& around) const {
    if (mode == "TOUCH") return {around.touched[channel_] ? 1 : 0};
    if (mode == "US-DIST-CM") return {static_cast<int>(std::lround(std::min(around.distance, 2.55) * 1000))};
    if (mode == "US-DIST-IN") return {static_cast<int>(std::lround(std::min(around.distance, 2.55) * 393.7))};
    if (mode == "GYRO-ANG") return {degrees(around.angle - zero_)};
    if (mode == "GYRO-RATE") return {degrees(around.rate)};
    if (mode == "GYRO-G&A") return {degrees(around.angle - zero_), degrees(around.rate)};
    if (mode == "RGB-RAW") return {around.floor.begin(), around.floor.end()};
    if (mode == "COL-REFLECT") return {std::min(100, around.floor[0] / 3)};
    return {0};
}

std::optional<std::string> Ev3Sensor::read(const std::string& attribute, const Ev3Surroundings& around,
                                           double now) const {
    if (attribute == "mode") return mode_ + "\n";
    if (attribute == "modes") {
        std::string all;
        for (const std::string& mode : modes_) all += (all.empty() ? "" : " ") + mode;
        return all + "\n";
    }
    if (attribute == "decimals") return mode_.starts_with("US-DIST") ? "1\n" : "0\n";
    const auto said = values(now - changed_at_ < stale ? before_ : mode_, around);
    if (attribute == "num_values") return std::to_string(said.size()) + "\n";
    if (!attribute.starts_with("value") || attribute.size() != 6) return std::nullopt;
    const auto index = static_cast<std::size_t>(attribute.back() - '0');
    return std::to_string(index < said.size() ? said[index] : 0) + "\n";
}

}  // namespace nezumi::fakes
