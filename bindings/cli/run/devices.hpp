// `nezumi run --hw`: its devices are the machine's, with a log if wanted, or those of a log.
#pragma once

#include <memory>
#include <optional>
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

    /// Begins the log, or reads the one that is played. An error names the file.
    static Expected<RunDevices> open(const Hardware& hardware);
    ~RunDevices() { close({}); }
    RunDevices(RunDevices&&) = default;
    RunDevices& operator=(RunDevices&&) = delete;

    const hw::DeviceRoots& roots() const { return roots_; }

    /// The ticks begin. `say` tells what a person should know, also later; the loop ends where a log that is played
    /// does. Both must outlive this.
    void follow(RunLoop& loop, Say say);
    /// The run is over, the robots are to be stopped.
    void end();
    /// The robots stand: tells what came of it. Whether what was played did as the log says; true without one.
    bool finish();
    /// The log is complete: after all that drove the robots. Tells what kept it from that.
    void close(const Say& say);
    /// What of the log is not written yet is not: `close` returns soon. From any thread.
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
