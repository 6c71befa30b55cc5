// Blur by OpenCV; noise from a table, because new random numbers for each picture would take most of the time.
#include "sim/image_noise.hpp"

#include <algorithm>
#include <cassert>
#include <opencv2/imgproc.hpp>

#include "engine/ports/payload.hpp"

namespace nezumi::sim {
namespace {

constexpr std::size_t offsets = 65'536;  // start positions in the table for a row

}  // namespace

void blur_picture(std::vector<std::uint8_t>& pixels, int width, int height, int channels, double sigma) {
    if (sigma <= 0) return;
    cv::Mat picture(height, width, CV_8UC(channels), pixels.data());
    cv::GaussianBlur(picture, picture, {}, sigma, sigma, cv::BORDER_REPLICATE);
}

ImageNoise::ImageNoise(double sigma, std::uint64_t seed) : seed_(seed) {
    if (sigma <= 0) return;
    table_.resize(offsets + most_row);
    cv::Mat values(1, static_cast<int>(table_.size()), CV_16SC1, table_.data());
    // Rounded here: pixel values are integers, so rounding the sum would give the same.
    cv::RNG(seed).fill(values, cv::RNG::NORMAL, 0.0, sigma);
}

void ImageNoise::add_to(std::vector<std::uint8_t>& pixels, std::size_t row, std::uint64_t frame) const {
    assert(row > 0 && row <= most_row && pixels.size() % row == 0);
    if (table_.empty()) return;
    const std::uint64_t of_frame = mix(seed_, frame);
    for (std::size_t first = 0; first < pixels.size(); first += row) {
        const std::int16_t* noise = &table_[mix(of_frame, first) % offsets];
        std::uint8_t* values = &pixels[first];
        for (std::size_t i = 0; i < row; ++i)
            values[i] = static_cast<std::uint8_t>(std::clamp(values[i] + noise[i], 0, 255));
    }
}

}  // namespace nezumi::sim
