// The devices of `nezumi run --hw`: those of the machine, optionally with a log, or a log that replaces them.
#pragma once

#include <memory>
#include <string>

#include "bindings/cli/run/hardware.hpp"
#include "engine/live/run_loop.hpp"
#include "hw/device/roots.hpp"
#include "hw/log/logged_files.hpp"
#include "hw/log/played_files.hpp"

namespace nezumi::cli {

class RunDevices {
public:
    using Say = std::function<void(const std::string& line)>;

    /// Starts the log, or reads the one to replay. An error names the file.
    static Expected<RunDevices> open(const Hardware& hardware);
    ~RunDevices() { close({}); }
    RunDevices(RunDevices&&) = default;
    RunDevices& operator=(RunDevices&&) = delete;

    const hw::DeviceRoots& roots() const { return roots_; }

    /// Called before the first tick. `say` gets messages for the user from now on. The loop ends at the end of a
    /// replayed log. `loop` and everything that `say` uses must outlive this object.
    void follow(RunLoop& loop, Say say);
    /// Called when the loop has ended, before the robots are stopped.
    void end();
    /// Called when the robots stand. Reports the result of a replay. Returns false if the replay differed from the log.
    bool finish();
    /// Completes the log, after all drivers have ended. Reports a failure.
    void close(const Say& say);
    /// Drops what is not written yet, so that `close` returns soon. Any thread may call it.
    void give_up();

private:
    RunDevices() = default;
    void after_tick();
    void tell_problem(const Say& say);

    hw::DeviceRoots roots_;
    std::string file_;  // the log
    std::shared_ptr<hw::LoggedFiles> logged_;
    std::shared_ptr<hw::PlayedFiles> played_;
    RunLoop* loop_ = nullptr;
    Say say_;
    bool has_told_problem_ = false;
};

}  // namespace nezumi::cli
