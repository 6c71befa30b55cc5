// The blur and noise of a real camera.
#pragma once

#include <cstdint>
#include <vector>

namespace nezumi::sim {

/// Blurs a picture of `channels` bytes per pixel with a Gaussian of this standard deviation [px]. The edge pixels are
/// repeated outside the picture.
void blur_picture(std::vector<std::uint8_t>& pixels, int width, int height, int channels, double sigma);

/// Normally distributed noise for pixel values from 0 to 255.
class ImageNoise {
public:
    /// `sigma` is the standard deviation. The same `seed` gives the same noise.
    ImageNoise(double sigma, std::uint64_t seed);

    /// Adds the noise of picture number `frame` to rows of `row` bytes, at most `most_row`. The noise depends on
    /// `frame` only, not on earlier calls. Values stay from 0 to 255.
    void add_to(std::vector<std::uint8_t>& pixels, std::size_t row, std::uint64_t frame) const;

    static constexpr std::size_t most_row = std::size_t{3} * 4096;

private:
    std::uint64_t seed_;
    std::vector<std::int16_t> table_;  // empty if there is no noise
};

}  // namespace nezumi::sim
