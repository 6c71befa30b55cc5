// A view counts when the board is found twice at the same place, far from all earlier views.
#include "hw/calibrate/camera.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace nezumi::hw {
namespace {

// Mean movement of the corners, as a part of the picture's width:
constexpr double still = 0.004;  // at most this while a person holds the board still
constexpr double apart = 0.05;   // at least this between a view and each earlier one

}  // namespace

Expected<IntrinsicsFit> calibrate_camera(const BoardCourse& course, const std::function<Expected<TimedPicture>()>& next,
                                         const std::function<void(const std::string& text)>& tell) {
    std::vector<Corners> views;
    std::optional<Corners> before;
    std::optional<double> since;  // [s] time of the last view
    int width = 0, height = 0;
    while (static_cast<int>(views.size()) < course.views) {
        const auto picture = next();
        if (!picture) return Unexpected(picture.error());
        const auto gray = to_gray(picture->image);
        if (!gray) return Unexpected(gray.error());
        width = gray->width;
        height = gray->height;
        if (picture->tm - since.value_or(picture->tm) > course.patience) {
            return failure(
                fmt::format("no new view of the board for {} s, {} of {} were taken: is all of it in the picture, has "
                            "it {} x {} inner corners and a white margin, is it bright enough?",
                            course.patience, views.size(), course.views, course.board.columns, course.board.rows));
        }
        if (!since) since = picture->tm;
        auto corners = find_corners(*gray, course.board);
        const bool stands = corners && before && mean_distance(*corners, *before) < still * width;
        before = std::move(corners);
        const auto is_near = [&](const Corners& view) { return mean_distance(view, *before) < apart * width; };
        if (!stands || std::any_of(views.begin(), views.end(), is_near)) continue;
        views.push_back(*before);
        since = picture->tm;
        tell(fmt::format("view {} of {}", views.size(), course.views));
    }
    return fit_intrinsics(views, course.board, width, height);
}

}  // namespace nezumi::hw
