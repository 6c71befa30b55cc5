// Blur in two passes of whole numbers, noise from a counter.
#include "sim/image_noise.hpp"

#include <algorithm>
#include <cmath>

#include "engine/ports/payload.hpp"

namespace nezumi::sim {
namespace {

// Weights of a Gaussian from the middle outwards; with the mirrored half they add up to 65536.
std::vector<std::uint32_t> weights_of(double sigma) {
    const int reach = static_cast<int>(std::ceil(3 * sigma));
    std::vector<double> shape;
    double sum = 0;
    for (int i = 0; i <= reach; ++i) {
        shape.push_back(std::exp(-0.5 * i * i / (sigma * sigma)));
        sum += shape.back() * (i == 0 ? 1 : 2);
    }
    std::vector<std::uint32_t> weights;
    std::uint32_t outside = 0;
    for (const double s : shape) {
        weights.push_back(static_cast<std::uint32_t>(std::lround(65536 * s / sum)));
        if (weights.size() > 1) outside += 2 * weights.back();
    }
    weights[0] = 65536 - outside;
    return weights;
}

// One pass along `count` values that lie `stride` apart, over `padded`, which has room for them and `reach` on each
// side.
void blur_line(std::uint8_t* values, int count, std::size_t stride, const std::vector<std::uint32_t>& weights,
               std::vector<std::uint8_t>& padded) {
    const int reach = static_cast<int>(weights.size()) - 1;
    for (int i = -reach; i < count + reach; ++i) {
        padded[static_cast<std::size_t>(i + reach)] =
            values[static_cast<std::size_t>(std::clamp(i, 0, count - 1)) * stride];
    }
    for (int i = 0; i < count; ++i) {
        const std::uint8_t* middle = &padded[static_cast<std::size_t>(i + reach)];
        std::uint32_t sum = weights[0] * *middle + 32768;
        for (int k = 1; k <= reach; ++k)
            sum += weights[static_cast<std::size_t>(k)] * (middle[k] + std::uint32_t{middle[-k]});
        values[static_cast<std::size_t>(i) * stride] = static_cast<std::uint8_t>(sum >> 16);
    }
}

}  // namespace

void blur_picture(std::vector<std::uint8_t>& pixels, int width, int height, int channels, double sigma) {
    if (sigma <= 0) return;
    const auto weights = weights_of(sigma);
    const std::size_t row = static_cast<std::size_t>(width) * channels;
    std::vector<std::uint8_t> padded(static_cast<std::size_t>(std::max(width, height)) + 2 * weights.size());
    for (int y = 0; y < height; ++y) {
        for (int c = 0; c < channels; ++c) blur_line(&pixels[y * row + c], width, channels, weights, padded);
    }
    // Down the picture a whole row at a time: columns one by one would miss the cache at every step.
    const int reach = static_cast<int>(weights.size()) - 1;
    const std::vector<std::uint8_t> from = pixels;
    std::vector<std::uint32_t> sums(row);
    for (int y = 0; y < height; ++y) {
        std::fill(sums.begin(), sums.end(), 32768);
        for (int k = -reach; k <= reach; ++k) {
            const std::uint8_t* line = &from[static_cast<std::size_t>(std::clamp(y + k, 0, height - 1)) * row];
            const std::uint32_t weight = weights[static_cast<std::size_t>(std::abs(k))];
            for (std::size_t i = 0; i < row; ++i) sums[i] += weight * line[i];
        }
        for (std::size_t i = 0; i < row; ++i) pixels[y * row + i] = static_cast<std::uint8_t>(sums[i] >> 16);
    }
}

void add_noise(std::vector<std::uint8_t>& pixels, double sigma, std::uint64_t seed) {
    if (sigma <= 0) return;
    // Four even draws of 0 to 255 have the variance 4 * (256^2 - 1) / 12.
    const float scale = static_cast<float>(sigma / std::sqrt(4.0 * 65535.0 / 12.0));
    const auto bytes_of = [](std::uint32_t bits) {
        return (bits & 0xff) + (bits >> 8 & 0xff) + (bits >> 16 & 0xff) + (bits >> 24);
    };
    for (std::size_t i = 0; i < pixels.size(); i += 2) {
        const std::uint64_t bits = mix(seed, i);
        for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
            if (i + k >= pixels.size()) break;
            const std::uint32_t drawn = bytes_of(static_cast<std::uint32_t>(bits >> (32 * k)));
            const float value = static_cast<float>(pixels[i + k]) + scale * (static_cast<float>(drawn) - 510.0F);
            pixels[i + k] = static_cast<std::uint8_t>(std::clamp(value + 0.5F, 0.0F, 255.0F));
        }
    }
}

}  // namespace nezumi::sim
