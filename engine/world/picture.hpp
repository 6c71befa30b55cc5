// Pictures on surfaces: from a file on the floor, or of a marker.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/values/type.hpp"
#include "engine/world/floor_color.hpp"

namespace nezumi {

struct Picture {
    int width = 0;            ///< [px]
    int height = 0;           ///< [px]
    std::vector<Rgb> pixels;  ///< row by row from the top left
};

struct JpegPicture {
    int width = 0;   ///< [px]
    int height = 0;  ///< [px]
    Octets bytes;    ///< of a JPEG file
};

/// Reads a picture file. The error gives the reason.
using PictureReader = std::function<Expected<Picture>(const std::string& file)>;

/// The picture in the content of a file, in any format of OpenCV; loads a module for this. Transparent parts are white.
/// The error has the reason, without a location.
Expected<Picture> decode_picture(std::string_view bytes);
/// Pixels row by row from the top left, each one grey value (`channels` 1) or red, green and blue (3), as JPEG.
Expected<JpegPicture> encode_jpeg(int width, int height, int channels, const Octets& pixels);
/// Whether this program can decode pictures; a program without simulation does not need it.
bool decodes_pictures();

/// The error for too many pixels, or "".
std::string too_many_pixels(std::int64_t width, std::int64_t height);

/// A marker (a tag of AprilTag's family 36h11) is 10 x 10 cells with its white margin. The outer edges of its black
/// border enclose 8 x 8 cells.
inline constexpr int tag_cells = 10, tag_border_cells = 8;
inline constexpr int tag_count = 587;  ///< in the family

}  // namespace nezumi
