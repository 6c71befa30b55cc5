// The brick's screen, painted on a thread of its own.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/mutex.hpp"
#include "engine/ports/messages.hpp"
#include "hw/device/files.hpp"
#include "hw/device/health.hpp"
#include "hw/device/worker.hpp"

namespace nezumi::hw {

/// What a frame buffer wants to have.
struct ScreenFormat {
    int width = 178, height = 128;  ///< [px]
    int bits_per_pixel = 32;        ///< 32: XRGB, 8 bits each; 1: lowest bit first, 1 is dark
    int stride = 712;               ///< [bytes] from row to row
};

/// The picture, 8 (grey), 24 (rgb) or 32 bits (rgb and one that does not count) a pixel, as large as fits in the middle
/// of a white screen. "" when it has other bits. Where there is one bit a pixel, less than half the light is dark.
std::string paint_screen(const CameraImage& picture, const ScreenFormat& format);

/// A job.
class BrickScreen final : public DeviceJob {
public:
    /// `frame_buffer` is "/dev/fb0"; `properties` the folder that says what it is, "/sys/class/graphics/fb0".
    BrickScreen(DevicePath frame_buffer, DevicePath properties)
        : frame_buffer_(std::move(frame_buffer)), properties_(std::move(properties)) {}

    /// From the control loop: the newest counts.
    void show(const CameraImage& picture);
    std::vector<std::string> take_faults();

    double run() override;

private:
    ScreenFormat format() const;

    const DevicePath frame_buffer_, properties_;
    Health health_{"screen"};
    Mutex mutex_;  // held for a copy at most
    std::optional<CameraImage> newest_;
};

}  // namespace nezumi::hw
