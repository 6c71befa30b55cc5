// Camera calibration: the guided collection of views of a chessboard, and the intrinsics that fit them.
#pragma once

#include <functional>
#include <string>

#include "engine/vision/intrinsics_fit.hpp"

namespace nezumi::hw {

struct BoardCourse {
    BoardSize board;
    int views = 20;         ///< number of views to take
    double patience = 120;  ///< [s] without a new view until the calibration fails
};

/// A picture and its time [s].
struct TimedPicture {
    CameraImage image;
    double tm = 0;
};

/// Takes views of the board from the pictures that `next` returns: those in which the board does not move and is far
/// from all earlier views. Passes the number of views so far to `tell`. Errors are those of `next` and
/// `fit_intrinsics`, or that no new view came.
Expected<IntrinsicsFit> calibrate_camera(const BoardCourse& course, const std::function<Expected<TimedPicture>()>& next,
                                         const std::function<void(const std::string& text)>& tell);

}  // namespace nezumi::hw
