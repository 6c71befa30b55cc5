// What a real camera does to a picture.
#pragma once

#include <cstdint>
#include <vector>

namespace nezumi::sim {

/// Blurs a picture of `channels` bytes a pixel with a Gaussian of this standard deviation [px]; what lies beyond its
/// edges is as the edge.
void blur_picture(std::vector<std::uint8_t>& pixels, int width, int height, int channels, double sigma);

/// Adds noise of this standard deviation to every value and keeps it from 0 to 255. Nearly normal (the sum of four even
/// draws, at most 3.5 deviations); `seed` decides it all.
void add_noise(std::vector<std::uint8_t>& pixels, double sigma, std::uint64_t seed);

}  // namespace nezumi::sim
