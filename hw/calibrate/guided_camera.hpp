// A camera alone in its system, for calibration.
#pragma once

#include <csignal>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "engine/base/log.hpp"
#include "engine/system/build_system.hpp"
#include "engine/system/pacer.hpp"
#include "engine/system/system.hpp"
#include "hw/calibrate/camera.hpp"

namespace nezumi::hw {

/// Runs one camera with the settings of a system but without its earlier calibration.
class GuidedCamera {
public:
    struct Options {
        bool simulated = false;  ///< a simulated camera over a chessboard, see `view_of_chessboard`
        const volatile std::sig_atomic_t* end = nullptr;    ///< if not 0, waiting for a picture ends
        std::function<void(const LogLine& line)> log = {};  ///< optional
    };

    /// Makes the camera `name`, which must exist in `spec`: a simulated camera, or the real one with the default driver
    /// of `makers`. Fails if the camera is not on a robot, because its calibration is stored in the file of the robot.
    /// Other errors as of `build_system`.
    static Expected<std::unique_ptr<GuidedCamera>> make(SystemSpec spec, const std::string& name, const Makers& makers,
                                                        Options options);

    /// Waits for the next picture. Fails when the person ends the program.
    Expected<TimedPicture> next();

    const std::string& name() const { return entry_.name; }
    const RobotEntry& robot() const { return robot_; }

private:
    GuidedCamera(SystemSpec spec, Options options) : spec_(std::move(spec)), options_(std::move(options)) {}
    Expected<void> build(const Makers& makers);
    Expected<TimedPicture> rehearse();

    SystemSpec spec_;  // must outlive the system
    const Options options_;
    ComponentEntry entry_;
    RobotEntry robot_;
    std::unique_ptr<System> system_;
    std::unique_ptr<Pacer> pacer_;
    const OutPort<CameraImage>* out_ = nullptr;
    std::uint64_t count_ = 0;  // number of messages already used
};

}  // namespace nezumi::hw
