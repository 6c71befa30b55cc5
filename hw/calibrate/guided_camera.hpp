// A camera whose pictures a sub-command looks at, alone in its system.
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

/// Runs the camera alone, with what a system says of it and without what was measured before.
class GuidedCamera {
public:
    struct Options {
        bool simulated = false;                             ///< held over a chessboard, as `view_of_chessboard` says
        const volatile std::sig_atomic_t* end = nullptr;    ///< not 0: no further picture is waited for
        std::function<void(const LogLine& line)> log = {};  ///< may be empty
    };

    /// The camera of this name in `spec`, which must be there. `makers` make it: simulated, or the real one by the
    /// driver that they have for cameras. A camera is on a robot: what is measured is in that one's file. Errors as of
    /// `build_system`.
    static Expected<std::unique_ptr<GuidedCamera>> make(SystemSpec spec, const std::string& name, const Makers& makers,
                                                        Options options);

    /// The next picture; waits for it. An error when the person wants to end.
    Expected<TimedPicture> next();

    const std::string& name() const { return entry_.name; }
    const RobotEntry& robot() const { return robot_; }

private:
    GuidedCamera(SystemSpec spec, Options options) : spec_(std::move(spec)), options_(std::move(options)) {}
    Expected<void> build(const Makers& makers);
    Expected<TimedPicture> rehearse();

    SystemSpec spec_;  // outlives the system
    const Options options_;
    ComponentEntry entry_;
    RobotEntry robot_;
    std::unique_ptr<System> system_;
    std::unique_ptr<Pacer> pacer_;
    const OutPort<CameraImage>* out_ = nullptr;
    std::uint64_t count_ = 0;  // of its messages that were looked at
};

}  // namespace nezumi::hw
