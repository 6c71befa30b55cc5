// OpenCV labels the regions and computes the moments of one.
#include "engine/vision/blob.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace nezumi {

std::optional<Blob> largest_blob(const GrayImage& mask) {
    // cv::Mat has no constructor for const data; this one is only read.
    const cv::Mat marked(mask.height, mask.width, CV_8UC1, const_cast<std::uint8_t*>(mask.pixels.data()));
    cv::Mat labels, stats, centroids;
    const int count = cv::connectedComponentsWithStats(marked, labels, stats, centroids, 8, CV_32S);
    // The larger region; of two equal ones, the upper one.
    const auto rank = [&](int label) {
        return std::pair(stats.at<int>(label, cv::CC_STAT_AREA), -stats.at<int>(label, cv::CC_STAT_TOP));
    };
    int largest = 0;  // label 0 is the background
    for (int label = 1; label < count; ++label) {
        if (largest == 0 || rank(label) > rank(largest)) largest = label;
    }
    if (largest == 0) return std::nullopt;
    const cv::Rect box(stats.at<int>(largest, cv::CC_STAT_LEFT), stats.at<int>(largest, cv::CC_STAT_TOP),
                       stats.at<int>(largest, cv::CC_STAT_WIDTH), stats.at<int>(largest, cv::CC_STAT_HEIGHT));
    const cv::Mat part = labels(box) == largest;
    const cv::Moments m = cv::moments(part, true);
    // The axis of least inertia, measured from the vertical. Rows count downwards, so for a blob that leans to the
    // left, columns increase with rows.
    const double angle = std::atan2(2 * m.mu11, m.mu02 - m.mu20) / 2;
    return Blob{.x = box.x + m.m10 / m.m00, .y = box.y + m.m01 / m.m00, .area = m.m00, .angle = angle};
}

}  // namespace nezumi
