// What a real camera does to a picture.
#pragma once

#include <cstdint>
#include <vector>

namespace nezumi::sim {

/// Blurs a picture of `channels` bytes a pixel with a Gaussian of this standard deviation [px]; what lies beyond its
/// edges is as the edge.
void blur_picture(std::vector<std::uint8_t>& pixels, int width, int height, int channels, double sigma);

/// Normal noise for the values of a picture, from 0 to 255.
class ImageNoise {
public:
    /// `sigma` is its standard deviation, `seed` decides it all.
    ImageNoise(double sigma, std::uint64_t seed);

    /// Adds the noise of picture number `frame` to rows of `row` bytes, at most `most_row`; the same for the same
    /// number, whatever came before. Values stay from 0 to 255.
    void add_to(std::vector<std::uint8_t>& pixels, std::size_t row, std::uint64_t frame) const;

    static constexpr std::size_t most_row = std::size_t{3} * 4096;

private:
    std::uint64_t seed_;
    std::vector<std::int16_t> table_;  // empty without noise
};

}  // namespace nezumi::sim
