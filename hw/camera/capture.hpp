// A camera's device that is open: what the driver needs of it, and of it alone.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "engine/ports/messages.hpp"

namespace nezumi::hw {

/// What a camera is asked for, and what becomes of its pictures.
struct CaptureSettings {
    int width = 640;                  ///< [px]
    int height = 480;                 ///< [px]
    double frame_rate = 30;           ///< [Hz] the device may have another one
    bool color = true;                ///< red, green, blue; else grey
    CameraIntrinsics raw_intrinsics;  ///< for `undistort`
    std::string pixel_format;         ///< that it sends, four letters; "": what it likes
    bool undistort = false;           ///< the pictures become those of a pinhole with the same `fx`, `fy`, `cx`, `cy`
};

/// Not for two threads at once.
class Capture {
public:
    virtual ~Capture() = default;

    /// What `wait` came to.
    enum class Wait { frame, nothing, failed };
    /// Waits for the next frame, at most these seconds.
    virtual Wait wait(double seconds) = 0;
    /// [s] when the frame that `wait` gave was taken, by the device's driver: usually the monotonic clock.
    virtual double frame_time() const = 0;
    /// Makes that frame a picture: its bytes, row by row from the top left, replace `pixels`. False when it is torn.
    virtual bool take(std::vector<std::uint8_t>& pixels) = 0;
};

/// Opens the device of this node. An error says why not, with what to do.
using OpenCapture = std::function<tl::expected<std::unique_ptr<Capture>, std::string>(const std::string& node,
                                                                                      const CaptureSettings& settings)>;

/// By OpenCV's videoio, a module of the program that is loaded when the first camera is opened: it costs more to load
/// than all else of it together.
tl::expected<std::unique_ptr<Capture>, std::string> open_by_opencv(const std::string& node,
                                                                   const CaptureSettings& settings);
/// Loads that module. An error says why there are no cameras without it, with what to install.
tl::expected<void, std::string> load_opencv();

}  // namespace nezumi::hw
