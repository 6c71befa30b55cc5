// Converts a picture to the format of the frame buffer and writes it in one call.
#include "hw/ev3/screen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/world/floor_color.hpp"
#include "hw/device/clock.hpp"
#include "hw/device/node.hpp"
#include "hw/device/sampler.hpp"
#include "hw/ev3/device_class.hpp"

namespace nezumi::hw {
namespace {

constexpr Rgb white = 0xffffff;

Rgb pixel_of(const CameraImage& picture, std::size_t x, std::size_t y) {
    const std::size_t bytes = picture.bpp / 8;
    const std::uint8_t* pixel = picture.pixels.data() + (y * picture.width + x) * bytes;
    if (bytes == 1) return Rgb{pixel[0]} << 16 | Rgb{pixel[0]} << 8 | pixel[0];
    return Rgb{pixel[0]} << 16 | Rgb{pixel[1]} << 8 | pixel[2];
}

}  // namespace

std::string paint_screen(const CameraImage& picture, const ScreenFormat& format) {
    if (picture.bpp != 8 && picture.bpp != 24 && picture.bpp != 32) return "";
    const double scale = std::max(
        {static_cast<double>(picture.width) / format.width, static_cast<double>(picture.height) / format.height});
    const int width = std::min(format.width, static_cast<int>(std::lround(picture.width / scale))),
              height = std::min(format.height, static_cast<int>(std::lround(picture.height / scale)));
    const int left = (format.width - width) / 2, top = (format.height - height) / 2;
    std::string frame(static_cast<std::size_t>(format.stride) * static_cast<std::size_t>(format.height), '\0');
    for (int y = 0; y < format.height; ++y) {
        char* row = frame.data() + static_cast<std::ptrdiff_t>(y) * format.stride;
        for (int x = 0; x < format.width; ++x) {
            Rgb color = white;
            if (x >= left && x < left + width && y >= top && y < top + height) {
                const auto source = [scale](int place, int size) {
                    return std::min(static_cast<std::size_t>(size) - 1,
                                    static_cast<std::size_t>((place + 0.5) * scale));
                };
                color = pixel_of(picture, source(x - left, picture.width), source(y - top, picture.height));
            }
            if (format.bits_per_pixel == 1) {
                const int bit = brightness(color) < 50 ? 1 << (x % 8) : 0;
                row[x / 8] = static_cast<char>(static_cast<unsigned char>(row[x / 8]) | bit);
            } else {
                for (int byte = 0; byte < 3; ++byte) row[4 * x + byte] = static_cast<char>(color >> (8 * byte) & 0xff);
            }
        }
    }
    return frame;
}

void BrickScreen::show(const CameraImage& picture) {
    const std::lock_guard lock(mutex_);
    newest_ = picture;
}

std::vector<std::string> BrickScreen::take_faults() {
    if (hangs(clock_seconds())) health_.lost(no_answer);
    return health_.take();
}

ScreenFormat BrickScreen::format() const {
    ScreenFormat format;
    Node bits(properties_ + "/bits_per_pixel", Node::Access::read), stride(properties_ + "/stride", Node::Access::read);
    const auto bits_per_pixel = read_whole_number(bits), bytes = read_whole_number(stride);
    if (!bits_per_pixel || !bytes) return format;
    const int least = *bits_per_pixel == 1 ? (format.width + 7) / 8 : 4 * format.width;
    format.bits_per_pixel = *bits_per_pixel == 1 ? 1 : 32;
    format.stride = static_cast<int>(std::clamp<long long>(*bytes, least, 1 << 14));
    return format;
}

double BrickScreen::run() {
    constexpr double idle = 1;  // [s]; a new picture wakes it earlier
    std::optional<CameraImage> picture;
    {
        const std::lock_guard lock(mutex_);
        picture = std::exchange(newest_, std::nullopt);
    }
    if (!picture) return idle;
    const std::string frame = paint_screen(*picture, format());
    if (frame.empty()) {
        health_.lost(fmt::format("a picture of {} bits per pixel is not shown: expected 8, 24 or 32", picture->bpp));
        return idle;
    }
    // A frame buffer continues after the last write, so it is opened for each picture.
    if (auto ok = Node(frame_buffer_, Node::Access::write).write(frame); !ok) {
        health_.lost(with_ev3_advice(ok.error()));
        const std::lock_guard lock(mutex_);
        if (!newest_) newest_ = std::move(picture);
        return retry_period;
    }
    health_.works();
    return idle;
}

}  // namespace nezumi::hw
