// Accesses device files and writes each access to a device log.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/file_writer.hpp"
#include "engine/base/mutex.hpp"
#include "engine/base/result_file.hpp"
#include "hw/device/files.hpp"
#include "hw/device/roots.hpp"
#include "hw/log/device_log.hpp"

namespace nezumi::hw {

/// Each line is written in one call as soon as the access has returned, so the log of a killed process has complete
/// lines. If the log can't be written, the devices still work.
class LoggedFiles final : public DeviceFiles, public std::enable_shared_from_this<LoggedFiles> {
public:
    /// Starts a log of accesses through `roots`. An older log of the same name is kept until `close`. Fails if the file
    /// can't be written.
    static Expected<std::shared_ptr<LoggedFiles>> create(const std::string& file, const DeviceRoots& roots);

    Answer<std::unique_ptr<OpenFile>> open(const std::string& path, Access access) override;
    Answer<std::vector<std::string>> list(const std::string& folder) override;
    bool are_real() const override { return roots_.files->are_real(); }

    /// Logs that the ticks start.
    void start();
    /// Logs that the run has ended. Later lines show how the robots are stopped.
    void end();
    /// The errno of the error after which nothing more is written to the log; 0: none.
    int problem() const { return writer_.problem(); }
    /// Drops what is not written yet, so that `close` returns soon. Any thread may call it.
    void give_up() { writer_.give_up(); }
    /// The log's file, and the place of the older log.
    const ResultFile& file() const { return file_; }
    /// Writes the rest of the log, including the calls that have not returned. Returns an errno or 0. Call it once.
    int close();

    /// Logs a call. `answer` executes it, completes the fields of `call`, and returns the result.
    template <class Do>
    auto logged(DeviceCall call, Do answer) {
        const std::uint64_t number = begin(call);
        auto result = answer(call);
        if (!result) call.error = result.error();
        finish(number, std::move(call));
        return result;
    }

private:
    LoggedFiles(ResultFile file, DeviceRoots roots);
    double now() const;
    std::string canonical(const std::string& path) const;
    std::uint64_t begin(DeviceCall& call);
    void finish(std::uint64_t number, DeviceCall call);

    const DeviceRoots roots_;
    const double began_;  // [s] by `clock_seconds`
    ResultFile file_;
    FileWriter writer_;
    Mutex mutex_;  // held only for a copy
    std::uint64_t calls_ = 0;
    std::map<std::uint64_t, DeviceCall> waiting_;  // calls that have not returned
    bool is_closed_ = false;
};

}  // namespace nezumi::hw
