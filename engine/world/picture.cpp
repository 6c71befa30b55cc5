// Pictures are decoded and encoded in a module, because loading OpenCV's formats takes longer than loading the rest of
// the program.
#include "engine/world/picture.hpp"

#include <fmt/format.h>

#include <cassert>

#include "engine/base/module.hpp"
#include "engine/world/image_module.hpp"

namespace nezumi {
namespace {

constexpr Module module_with(const char* function) {
    return {.file = image_module, .function = function, .part = "pictures", .needs = "libopencv-imgcodecs406"};
}

}  // namespace

std::string too_many_pixels(std::int64_t width, std::int64_t height) {
    constexpr std::int64_t most = 64'000'000;  // 8000 x 8000
    if (width * height <= most) return "";
    return fmt::format("it has {} x {} pixels, expected at most {} million", width, height, most / 1'000'000);
}

Expected<Picture> decode_picture(std::string_view bytes) {
    static const auto decodes = load_function(module_with(decode_in_module));
    if (!decodes) return Unexpected(decodes.error());
    Picture picture;
    std::string problem;
    const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    if (reinterpret_cast<DecodeInModule*>(*decodes)(data, bytes.size(), picture, problem))
        problem = too_many_pixels(picture.width, picture.height);
    if (!problem.empty()) return failure(std::move(problem));
    return picture;
}

Expected<JpegPicture> encode_jpeg(int width, int height, int channels, const Octets& pixels) {
    static const auto encodes = load_function(module_with(encode_in_module));
    if (!encodes) return Unexpected(encodes.error());
    assert(pixels.size() == std::size_t(width) * std::size_t(height) * std::size_t(channels));
    JpegPicture jpeg{.width = width, .height = height, .bytes = {}};
    std::string problem;
    if (!reinterpret_cast<EncodeInModule*>(*encodes)(width, height, channels, pixels.data(), jpeg.bytes, problem))
        return failure(std::move(problem));
    return jpeg;
}

bool decodes_pictures() { return is_built_with(module_with(decode_in_module)); }

}  // namespace nezumi
