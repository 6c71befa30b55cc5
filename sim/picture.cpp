// Reads PNG by libpng, other formats by a module.
#include "sim/picture.hpp"

#include <fmt/format.h>
#include <png.h>

#include <filesystem>
#include <memory>

#include "engine/base/number_in.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi::sim {
namespace {

constexpr std::size_t largest_picture = std::size_t{256} << 20;  // bytes
constexpr Rgb grey = 0x8a8f98;

// The error if these bytes are not a PNG, or "".
std::string read_png(std::string_view bytes, Picture& picture) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    const std::unique_ptr<png_image, decltype(&png_image_free)> freed(&image, png_image_free);
    if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) return image.message;
    if (std::string problem = too_many_pixels(image.width, image.height); !problem.empty()) return problem;
    image.format = PNG_FORMAT_RGB;
    std::vector<png_byte> rgb(PNG_IMAGE_SIZE(image));
    const png_color white{255, 255, 255};
    if (png_image_finish_read(&image, &white, rgb.data(), 0, nullptr) == 0) return image.message;
    picture = {static_cast<int>(image.width), static_cast<int>(image.height), {}};
    picture.pixels.reserve(rgb.size() / 3);
    for (std::size_t i = 0; i + 2 < rgb.size(); i += 3)
        picture.pixels.push_back(Rgb{rgb[i]} << 16 | Rgb{rgb[i + 1]} << 8 | rgb[i + 2]);
    return "";
}

}  // namespace

Expected<Picture> read_picture(const std::string& file) {
    const bool is_called_png = std::filesystem::path(file).extension() == ".png";
    const auto text = read_whole(file, file, largest_picture);
    const auto refuse = [&](std::string_view why) {
        return failure(fmt::format("'{}' can't be read as a {}: {}", file, is_called_png ? "PNG" : "picture", why));
    };
    if (!text) return refuse(text.error().message);
    Picture picture;
    if (is_called_png || text->starts_with("\x89PNG")) {
        if (const std::string problem = read_png(*text, picture); !problem.empty()) return refuse(problem);
        return picture;
    }
    auto decoded = decode_picture(*text);
    if (!decoded) return refuse(decoded.error().message);
    return decoded;
}

Rgb parse_color(const std::string& text) {
    if (text.size() != 7 || text[0] != '#') return grey;
    return number_in<Rgb>(std::string_view(text).substr(1), 16).value_or(grey);
}

}  // namespace nezumi::sim
