// The devices of `nezumi run --hw`: the machine's, optionally with a log, or a replayed log.
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

    /// The ticks start. `say` gets messages for people, also later. The loop ends at the end of a replayed log. Both
    /// must outlive this object.
    void follow(RunLoop& loop, Say say);
    /// The run is over; the robots will be stopped.
    void end();
    /// The robots stand: reports the result of a replay. Returns true if it agreed with the log, or without a replay.
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
