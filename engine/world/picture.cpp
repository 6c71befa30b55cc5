// Pictures are decoded in a module: readers of their formats cost more to load than all else of the program.
#include "engine/world/picture.hpp"

#include <fmt/format.h>

#include "engine/base/module.hpp"
#include "engine/world/image_module.hpp"

namespace nezumi {
namespace {

constexpr Module pictures{
    .file = image_module, .function = decode_in_module, .part = "pictures", .needs = "libopencv-imgcodecs406"};

}  // namespace

std::string too_many_pixels(std::int64_t width, std::int64_t height) {
    constexpr std::int64_t most = 64'000'000;  // 8000 x 8000
    if (width * height <= most) return "";
    return fmt::format("it has {} x {} pixels, expected at most {} million", width, height, most / 1'000'000);
}

Expected<Picture> decode_picture(std::string_view bytes) {
    static const auto decodes = load_function(pictures);
    if (!decodes) return Unexpected(decodes.error());
    Picture picture;
    std::string problem;
    const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    if (reinterpret_cast<DecodeInModule*>(*decodes)(data, bytes.size(), picture, problem))
        problem = too_many_pixels(picture.width, picture.height);
    if (!problem.empty()) return failure(std::move(problem));
    return picture;
}

bool decodes_pictures() { return is_built_with(pictures); }

}  // namespace nezumi
