// For a real robot the smallest of three limits applies: the system file's, the model's, and the hardware's until the
// odometry is calibrated.
#include "engine/system/robot_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace nezumi {
namespace {

struct Limit {
    std::optional<double> LimitChanges::*asked;
    double Limits::*value;
    std::string_view unit;
};

constexpr std::array limits{Limit{&LimitChanges::speed, &Limits::speed, "m/s"},
                            Limit{&LimitChanges::yaw_rate, &Limits::yaw_rate, "rad/s"},
                            Limit{&LimitChanges::acceleration, &Limits::acceleration, "m/s^2"},
                            Limit{&LimitChanges::yaw_acceleration, &Limits::yaw_acceleration, "rad/s^2"}};

double most_of(const Limit& limit, const DriveSpec& drive) {
    return std::min(drive.limits.*limit.value, drive.hardware_limits.*limit.value);
}

}  // namespace

Limits limits_of(const RobotEntry& entry, const DriveSpec& drive) {
    Limits all = drive.limits;
    for (const Limit& limit : limits) {
        double& value = all.*limit.value;
        value = (entry.limits.*limit.asked).value_or(value);
        if (entry.is_real()) value = std::min(value, most_of(limit, drive));
    }
    return all;
}

std::string lowered_limits(const RobotEntry& entry, const DriveSpec& drive) {
    if (!entry.is_real()) return "";
    std::vector<std::string> lowered, after_calibration;
    for (const Limit& limit : limits) {
        const auto asked = entry.limits.*limit.asked;
        const double most = most_of(limit, drive), of_model = drive.limits.*limit.value;
        if (!asked || *asked <= most) continue;
        lowered.push_back(fmt::format("{} {} instead of {}", most, limit.unit, *asked));
        if (most < of_model) after_calibration.push_back(fmt::format("{} {}", std::min(*asked, of_model), limit.unit));
    }
    if (lowered.empty()) return "";
    return fmt::format("limits: the real robot gets {}: {}", fmt::join(lowered, ", "),
                       after_calibration.empty()
                           ? "its model allows no more, and a system file can exceed that only in simulation"
                           : fmt::format("once its odometry is calibrated (nezumi calibrate odometry) it gets {}",
                                         fmt::join(after_calibration, ", ")));
}

}  // namespace nezumi
