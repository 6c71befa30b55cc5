// Wheels' radii and track from drives whose ends were measured.
#pragma once

#include <vector>

#include "engine/base/error.hpp"
#include "engine/ports/messages.hpp"
#include "engine/world/calibration.hpp"
#include "engine/world/world.hpp"

namespace nezumi {

/// A drive as the odometry saw it, and where it truly ended.
struct MeasuredDrive {
    std::vector<Wheels> travel;  ///< [m] of each rim, tick by tick, by the radii that the odometry had
    Point2D end;                 ///< [m] in the frame of its start: x ahead, y to the left
};

struct WheelFit {
    WheelCalibration wheels;
    double before = 0;  ///< [m] root mean square of the distances between the ends and what the odometry said of them
    double after = 0;   ///< [m] the same with the calibrated wheels
};

/// Where a drive ends with these wheels, when its travel was told with those in `believed`.
Point2D end_of(const MeasuredDrive& drive, const WheelCalibration& believed, const WheelCalibration& wheels);

/// The wheels that bring the odometry's ends as near as can be to those measured: least squares over both radii and the
/// track by Gauss and Newton, begun at `believed`. It needs a straight drive for the radii's size, and squares both
/// ways round to tell a wrong track from unequal wheels (Borenstein and Feng 1996, UMBmark). An error when the drives
/// do not tell them, or when the result is out of all proportion: something was measured wrongly.
Expected<WheelFit> fit_wheels(const std::vector<MeasuredDrive>& drives, const WheelCalibration& believed);

}  // namespace nezumi
