// Device files whose use is written to a device log, beside the threads that use them.
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

/// Each line is written whole as soon as its call has come back: a process that is killed leaves a log of whole lines.
/// When the log can't be written any more, the devices go on without it.
class LoggedFiles final : public DeviceFiles, public std::enable_shared_from_this<LoggedFiles> {
public:
    /// Begins a log of what is done through the files of `roots`; the older one of its name is set aside until it is
    /// closed. An error when the file can't be written.
    static Expected<std::shared_ptr<LoggedFiles>> create(const std::string& file, const DeviceRoots& roots);

    Answer<std::unique_ptr<OpenFile>> open(const std::string& path, Access access) override;
    Answer<std::vector<std::string>> list(const std::string& folder) override;
    bool are_real() const override { return roots_.files->are_real(); }

    /// The ticks begin.
    void start();
    /// The run is over; the robots are to be stopped.
    void end();
    /// The error that ended the writing (an errno), 0 so far.
    int problem() const { return writer_.problem(); }
    /// What is not written yet is not: `close` returns soon. From any thread.
    void give_up() { writer_.give_up(); }
    /// The log, and where the older one of its name is.
    const ResultFile& file() const { return file_; }
    /// Writes what is still to be written, calls that have not come back as well. Returns the error, or 0. Once.
    int close();

    /// Does a call, and logs it: `answer` gives its result and fills in what the line says of it.
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
    Mutex mutex_;  // held for a copy at most
    std::uint64_t calls_ = 0;
    std::map<std::uint64_t, DeviceCall> waiting_;  // that have not come back
    bool is_closed_ = false;
};

}  // namespace nezumi::hw
