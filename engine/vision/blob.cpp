// OpenCV labels the parts and sums up the moments of one.
#include "engine/vision/blob.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace nezumi {

std::optional<Blob> largest_blob(const GrayImage& mask) {
    // OpenCV has no matrix that is not to be written; this one is only read.
    const cv::Mat marked(mask.height, mask.width, CV_8UC1, const_cast<std::uint8_t*>(mask.pixels.data()));
    cv::Mat labels, stats, centroids;
    const int count = cv::connectedComponentsWithStats(marked, labels, stats, centroids, 8, CV_32S);
    // The larger one, of two as large the one that begins higher.
    const auto rank = [&](int label) {
        return std::pair(stats.at<int>(label, cv::CC_STAT_AREA), -stats.at<int>(label, cv::CC_STAT_TOP));
    };
    int largest = 0;  // label 0 is what is not marked
    for (int label = 1; label < count; ++label) {
        if (largest == 0 || rank(label) > rank(largest)) largest = label;
    }
    if (largest == 0) return std::nullopt;
    const cv::Rect box(stats.at<int>(largest, cv::CC_STAT_LEFT), stats.at<int>(largest, cv::CC_STAT_TOP),
                       stats.at<int>(largest, cv::CC_STAT_WIDTH), stats.at<int>(largest, cv::CC_STAT_HEIGHT));
    const cv::Mat part = labels(box) == largest;
    const cv::Moments m = cv::moments(part, true);
    // Of the axis of least inertia, from the upright: rows count downwards, so one that leans to the left has the
    // larger columns where the rows are larger.
    const double angle = std::atan2(2 * m.mu11, m.mu02 - m.mu20) / 2;
    return Blob{.x = box.x + m.m10 / m.m00, .y = box.y + m.m01 / m.m00, .area = m.m00, .angle = angle};
}

}  // namespace nezumi
