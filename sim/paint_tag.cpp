// Paints tags by the tables of AprilTag.
#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>

#include <cassert>
#include <cstdint>
#include <memory>
#include <vector>

#include "sim/picture.hpp"

namespace nezumi::sim {

Picture paint_tag(int id) {
    assert(id >= 0 && id < tag_count);
    const std::unique_ptr<apriltag_family_t, decltype(&tag36h11_destroy)> family(tag36h11_create(), tag36h11_destroy);
    assert(family->total_width == tag_cells && family->width_at_border == tag_border_cells);
    constexpr Rgb black = 0x141414, white = 0xebebeb;  // ink and paper
    constexpr int margin = (tag_cells - tag_border_cells) / 2;
    Picture picture{tag_cells, tag_cells, std::vector<Rgb>(tag_cells * tag_cells, white)};
    const auto cell = [&](std::uint32_t column, std::uint32_t row) -> Rgb& {
        return picture.pixels[(row + margin) * tag_cells + column + margin];
    };
    for (std::uint32_t row = 0; row < tag_border_cells; ++row) {
        for (std::uint32_t column = 0; column < tag_border_cells; ++column) cell(column, row) = black;
    }
    const std::uint64_t code = family->codes[id];
    for (std::uint32_t bit = 0; bit < family->nbits; ++bit) {
        // The first bit is the most significant one.
        if ((code >> (family->nbits - 1 - bit) & 1) != 0) cell(family->bit_x[bit], family->bit_y[bit]) = white;
    }
    return picture;
}

}  // namespace nezumi::sim
