// Computes the wheels' radii and the track from drives with measured ends.
#pragma once

#include <vector>

#include "engine/base/error.hpp"
#include "engine/ports/messages.hpp"
#include "engine/world/calibration.hpp"
#include "engine/world/world.hpp"

namespace nezumi {

/// A drive by its odometry, and its measured end.
struct MeasuredDrive {
    std::vector<Wheels> travel;  ///< [m] of each rim, tick by tick, with the radii of the odometry
    Point2D end;                 ///< [m] in the frame of the start: x forward, y left
};

struct WheelFit {
    WheelCalibration wheels;
    double before = 0;  ///< [m] root mean square distance between the measured ends and those of the odometry
    double after = 0;   ///< [m] the same with the calibrated wheels
};

/// The end of a drive with these wheels; the travel was recorded with the wheels `believed`.
Point2D end_of(const MeasuredDrive& drive, const WheelCalibration& believed, const WheelCalibration& wheels);

/// Finds the wheels with which the ends of the odometry are nearest to the measured ends: least squares over both radii
/// and the track by Gauss and Newton, starting with `believed`. It needs a straight drive for the size of the radii,
/// and squares in both directions to distinguish a wrong track from unequal wheels (Borenstein and Feng 1996, UMBmark).
/// An error if the drives do not determine the wheels, or if the result is not plausible because of a wrong
/// measurement.
Expected<WheelFit> fit_wheels(const std::vector<MeasuredDrive>& drives, const WheelCalibration& believed);

}  // namespace nezumi
