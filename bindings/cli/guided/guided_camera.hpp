// From a system file to a camera whose pictures a sub-command looks at.
#pragma once

#include <csignal>
#include <memory>
#include <string>

#include "bindings/cli/guided/setup.hpp"
#include "engine/system/pacer.hpp"
#include "engine/system/system.hpp"
#include "hw/calibrate/camera.hpp"

namespace nezumi::cli {

/// Which camera, and how it is reached.
struct CameraSetup {
    std::string file;        ///< a system file
    std::string camera;      ///< its name there; "": the only one
    bool simulated = false;  ///< held over a chessboard, as `view_of_chessboard` says
    Hardware hardware;       ///< of a real one; `robots` does not count
};

/// Runs the camera alone, with what the file says of it and without what was measured before.
class GuidedCamera {
public:
    /// Errors are those of the file, of the camera's parameters, or say which cameras there are. A camera is on a
    /// robot: what is measured is in that one's file.
    static Expected<std::unique_ptr<GuidedCamera>> make(const CameraSetup& setup,
                                                        const volatile std::sig_atomic_t& end);

    /// The next picture; waits for it. An error when the person wants to end.
    Expected<hw::TimedPicture> next();

    const std::string& name() const { return entry_.name; }
    const RobotEntry& robot() const { return robot_; }

private:
    GuidedCamera(const CameraSetup& setup, const volatile std::sig_atomic_t& end)
        : is_simulated_(setup.simulated), end_(end) {}
    Expected<void> choose(const CameraSetup& setup);
    Expected<void> build(const Hardware& hardware);
    Expected<hw::TimedPicture> rehearse();

    const bool is_simulated_;
    const volatile std::sig_atomic_t& end_;
    SystemSpec spec_;  // outlives the system
    ComponentEntry entry_;
    RobotEntry robot_;
    std::unique_ptr<System> system_;
    std::unique_ptr<Pacer> pacer_;
    const OutPort<CameraImage>* out_ = nullptr;
    std::uint64_t count_ = 0;  // of its messages that were looked at
};

}  // namespace nezumi::cli
