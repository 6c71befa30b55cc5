// A camera that Linux knows by a node video0, read on a thread of its own.
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

/// A job. Takes the camera up when it is plugged in, and again after it was unplugged, failed or fell silent.
class VideoCamera final : public DeviceJob {
public:
    /// `dev` stands for /dev. A device of the settings that begins with /dev/ is there.
    VideoCamera(std::string dev, const CameraSettings& settings, OpenCapture open);

    /// How often [s] it is looked for.
    static constexpr double search_period = 1;
    /// For how long [s] at least it may give no picture before it counts as silent.
    static constexpr double patience = 1;
    /// How long [s] opening it may take.
    static constexpr double slowest_opening = 3;

    /// From the control loop, at `now` by `clock_seconds`: when [s] by the same clock the newest picture was taken,
    /// which is then the one that `give` gives; nothing when there is no new one.
    std::optional<double> look(double now);
    /// From the control loop: the bytes of the picture. What `pixels` held is the memory of a later one.
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
    double frame_at_ = 0;               // [s] when the last frame came
    double due_ = 0;                    // [s] when the next picture is due, by its own time
    std::vector<std::uint8_t> filled_;  // where the next picture is made
    Health health_{"camera"};
    std::atomic<double> alive_at_;  // [s] when its thread went through `run`
    Mutex mutex_;                   // held for a swap at most
    std::vector<std::uint8_t> newest_;
    std::optional<double> newest_at_;
    std::vector<std::uint8_t> looked_at_;  // the control loop's own
};

/// The camera with its thread, as a Camera wants it. It stamps pictures with the system's time.
std::unique_ptr<CameraSource> open_camera(const std::string& dev, const CameraSettings& settings,
                                          OpenCapture open = open_by_opencv);

}  // namespace nezumi::hw
