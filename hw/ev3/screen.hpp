// The brick's screen, painted on its own thread.
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

/// The pixel format of a frame buffer.
struct ScreenFormat {
    int width = 178, height = 128;  ///< [px]
    int bits_per_pixel = 32;        ///< 32: XRGB, 8 bits each; 1: lowest bit first, 1 is dark
    int stride = 712;               ///< [bytes] per row
};

/// Scales the picture to the largest size that fits, in the middle of a white screen. The picture must have 8 (grey),
/// 24 (rgb) or 32 bits (rgb and an unused byte) per pixel; otherwise returns "". On a screen with one bit per pixel,
/// pixels of less than half brightness are dark.
std::string paint_screen(const CameraImage& picture, const ScreenFormat& format);

/// The job of painting the newest picture.
class BrickScreen final : public DeviceJob {
public:
    /// `frame_buffer`: "/dev/fb0". `properties`: the folder that describes its format, "/sys/class/graphics/fb0".
    BrickScreen(DevicePath frame_buffer, DevicePath properties)
        : frame_buffer_(std::move(frame_buffer)), properties_(std::move(properties)) {}

    /// Called by the control loop: shows the newest picture.
    void show(const CameraImage& picture);
    std::vector<std::string> take_faults();

    double run() override;

private:
    ScreenFormat format() const;

    const DevicePath frame_buffer_, properties_;
    Health health_{"screen"};
    Mutex mutex_;  // held only for a copy
    std::optional<CameraImage> newest_;
};

}  // namespace nezumi::hw
