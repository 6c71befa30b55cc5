// Gauss-Newton with numerical derivatives: three unknowns, a few dozen drives at most.
#include "engine/robot/wheel_fit.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>

namespace nezumi {
namespace {

using Scales = Eigen::Vector3d;  // of the left radius, the right radius and the track

constexpr double largest_change = 0.25;  // of a scale: a larger change is not plausible for this model
constexpr double longest_residual =
    0.05;  // relative to the longest drive: a larger residual is not an error of a tape measure

WheelCalibration scaled(const WheelCalibration& wheels, const Scales& scales) {
    return {.track = wheels.track * scales[2],
            .left_radius = wheels.left_radius * scales[0],
            .right_radius = wheels.right_radius * scales[1]};
}

Eigen::VectorXd residuals(const std::vector<MeasuredDrive>& drives, const WheelCalibration& believed,
                          const Scales& scales) {
    Eigen::VectorXd all(2 * static_cast<Eigen::Index>(drives.size()));
    const WheelCalibration wheels = scaled(believed, scales);
    Eigen::Index row = 0;
    for (const MeasuredDrive& drive : drives) {
        const Point2D end = end_of(drive, believed, wheels);
        all[row++] = end.x - drive.end.x;
        all[row++] = end.y - drive.end.y;
    }
    return all;
}

double root_mean_square(const Eigen::VectorXd& residuals) {
    return std::sqrt(residuals.squaredNorm() * 2 / static_cast<double>(residuals.size()));
}

double length_of(const MeasuredDrive& drive) {
    double length = 0;
    for (const Wheels& step : drive.travel) length += std::abs(step.left + step.right) / 2;
    return length;
}

}  // namespace

Point2D end_of(const MeasuredDrive& drive, const WheelCalibration& believed, const WheelCalibration& wheels) {
    const double left_scale = wheels.left_radius / believed.left_radius;
    const double right_scale = wheels.right_radius / believed.right_radius;
    Point2D end;
    double heading = 0;
    for (const Wheels& step : drive.travel) {
        const double left = step.left * left_scale, right = step.right * right_scale;
        const double ahead = (right + left) / 2, turn = (right - left) / wheels.track;
        // From the arc to its chord, to the third order; the turn within one tick is small.
        const double chord = ahead * (1 - turn * turn / 24);
        end.x += chord * std::cos(heading + turn / 2);
        end.y += chord * std::sin(heading + turn / 2);
        heading += turn;
    }
    return end;
}

Expected<WheelFit> fit_wheels(const std::vector<MeasuredDrive>& drives, const WheelCalibration& believed) {
    Scales scales = Scales::Ones();
    Eigen::VectorXd now = residuals(drives, believed, scales);
    WheelFit fit{.wheels = believed, .before = root_mean_square(now), .after = 0};
    for (int round = 0; round < 20; ++round) {
        constexpr double step = 1e-6;
        Eigen::MatrixX3d slopes(now.size(), 3);
        for (Eigen::Index i = 0; i < 3; ++i) {
            Scales moved = scales;
            moved[i] += step;
            slopes.col(i) = (residuals(drives, believed, moved) - now) / step;
        }
        const Eigen::Matrix3d normal = slopes.transpose() * slopes;
        // 1 for slopes at right angles to each other, 0 for dependent ones; not a number if a slope is 0.
        const double independence = normal.determinant() / normal.diagonal().prod();
        if (!(independence > 1e-12))
            return failure(
                "these drives do not determine the wheel parameters: drive a straight line, and squares in both "
                "directions");
        const Scales change = normal.inverse() * (slopes.transpose() * -now);
        scales += change;
        if (!((scales - Scales::Ones()).cwiseAbs().maxCoeff() < largest_change))
            return failure(
                "the result differs from the model by more than a quarter: was an end pose measured wrongly (x ahead, "
                "y to the left, in metres)?");
        now = residuals(drives, believed, scales);
        if (change.cwiseAbs().maxCoeff() < 1e-9) break;
    }
    fit.after = root_mean_square(now);
    fit.wheels = scaled(believed, scales);
    double longest = 0;
    for (const MeasuredDrive& drive : drives) longest = std::max(longest, length_of(drive));
    if (fit.after > longest_residual * longest)
        return failure(
            fmt::format("the measured end poses disagree by {:.3f} m: was one measured wrongly (x ahead, y to the "
                        "left, in metres), or did the robot slip?",
                        fit.after));
    return fit;
}

}  // namespace nezumi
