// A camera with a Linux video node, read on its own thread.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/mutex.hpp"
#include "engine/world/camera_source.hpp"
#include "hw/camera/capture.hpp"
#include "hw/device/health.hpp"
#include "hw/device/worker.hpp"

namespace nezumi::hw {

/// The job of reading a camera. Opens the camera when it is plugged in, and again after it was unplugged, failed or
/// stopped sending.
class VideoCamera final : public DeviceJob {
public:
    /// `dev` is /dev, or the folder that replaces it, also in device paths of the settings.
    VideoCamera(std::string dev, const CameraSettings& settings, OpenCapture open);

    /// Interval [s] of the search for the camera.
    static constexpr double search_period = 1;
    /// Time [s] without a picture after which the camera counts as silent; longer at low frame rates.
    static constexpr double patience = 1;
    /// Longest time [s] to open the camera.
    static constexpr double slowest_opening = 3;

    /// Called by the control loop at `now` (`clock_seconds`). Returns the time [s], by the same clock, of the newest
    /// picture, which `give` then gives; nothing if there is no new one.
    std::optional<double> look(double now);
    /// Called by the control loop. Gives the bytes of the picture; the old buffer of `pixels` is used for a later one.
    void give(std::vector<std::uint8_t>& pixels) { std::swap(pixels, looked_at_); }
    std::vector<std::string> take_faults() { return health_.take(); }

    double run() override;
    void end() override { capture_.reset(); }

private:
    tl::expected<void, std::string> find();
    void take_frame();
    void close(const std::string& why);
    bool is_due(double tm);

    const std::string dev_, wanted_;
    const OpenCapture open_;
    const CaptureSettings settings_;
    std::unique_ptr<Capture> capture_;
    std::string node_;                  // of capture_
    double frame_at_ = 0;               // [s] time of the last frame
    double due_ = 0;                    // [s] time at which the next picture is due
    std::vector<std::uint8_t> filled_;  // buffer for the next picture
    Health health_{"camera"};
    std::atomic<double> alive_at_;  // [s] time of the last call of `run`
    Mutex mutex_;                   // held only for a swap
    std::vector<std::uint8_t> newest_;
    std::optional<double> newest_at_;
    std::vector<std::uint8_t> looked_at_;  // used by the control loop only
};

/// A camera with its thread. Pictures have the system's time.
std::unique_ptr<CameraSource> open_camera(const std::string& dev, const CameraSettings& settings,
                                          OpenCapture open = open_by_opencv);

}  // namespace nezumi::hw
