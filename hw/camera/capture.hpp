// An open camera device, as the driver uses it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "engine/ports/messages.hpp"

namespace nezumi::hw {

/// The requested settings of a camera, and the processing of its pictures.
struct CaptureSettings {
    int width = 640;                  ///< [px]
    int height = 480;                 ///< [px]
    double frame_rate = 30;           ///< [Hz]; the device may choose another rate
    bool color = true;                ///< red, green, blue; otherwise grey
    CameraIntrinsics raw_intrinsics;  ///< for `undistort`
    std::string pixel_format;         ///< format that the device sends, four letters; "": the device's choice
    bool undistort = false;           ///< the pictures become those of a pinhole with the same `fx`, `fy`, `cx`, `cy`
};

/// An open camera. Not thread-safe.
class Capture {
public:
    virtual ~Capture() = default;

    /// The result of `wait`.
    enum class Wait { frame, nothing, failed };
    /// Waits for the next frame for at most `seconds`.
    virtual Wait wait(double seconds) = 0;
    /// The time [s] when the last frame was taken, given by the device driver: usually of the monotonic clock.
    virtual double frame_time() const = 0;
    /// Writes the last frame to `pixels`, row by row from the top left. Returns false if the frame is damaged.
    virtual bool take(std::vector<std::uint8_t>& pixels) = 0;
};

/// Opens the device node. An error gives the reason and what to do.
using OpenCapture = std::function<tl::expected<std::unique_ptr<Capture>, std::string>(const std::string& node,
                                                                                      const CaptureSettings& settings)>;

/// Uses OpenCV's videoio, a module that is loaded when the first camera is opened: loading it takes longer than loading
/// the rest of the program.
tl::expected<std::unique_ptr<Capture>, std::string> open_by_opencv(const std::string& node,
                                                                   const CaptureSettings& settings);
/// Loads the module with OpenCV's videoio. An error says why cameras can't be used, and what to install.
tl::expected<void, std::string> load_opencv();

}  // namespace nezumi::hw
