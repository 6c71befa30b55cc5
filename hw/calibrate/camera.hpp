// How a camera sees: the guided collection of views of a chessboard, and the lens that fits them.
#pragma once

#include <functional>
#include <string>

#include "engine/vision/intrinsics_fit.hpp"

namespace nezumi::hw {

struct BoardCourse {
    BoardSize board;
    int views = 20;         ///< that are taken
    double patience = 120;  ///< [s] without a new view after which it is given up
};

/// A picture and when [s] it was taken.
struct TimedPicture {
    CameraImage image;
    double tm = 0;
};

/// Takes views of the board from the pictures that `next` gives: those in which it stands still, and is elsewhere than
/// in all views before. Tells the person what is wanted next. Errors are those of `next` and of `fit_intrinsics`, or
/// say that no new view came.
Expected<IntrinsicsFit> calibrate_camera(const BoardCourse& course, const std::function<Expected<TimedPicture>()>& next,
                                         const std::function<void(const std::string& text)>& tell);

}  // namespace nezumi::hw
