// Device files that say what a device log has, at its times: the drivers run without the robot.
#pragma once

#include <condition_variable>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/mutex.hpp"
#include "hw/device/files.hpp"
#include "hw/log/device_log.hpp"
#include "hw/log/write_comparison.hpp"

namespace nezumi::hw {

/// A reading gets the next one of the log, when that comes in; who comes late the newest, who comes often the last one
/// again. What failed or hung in the log does so again. What is written is compared with what the log has. Times are
/// those of `clock_seconds` since this was made, or as `start` says.
class PlayedFiles final : public DeviceFiles, public std::enable_shared_from_this<PlayedFiles> {
public:
    /// `file` is the log's name in what is told.
    PlayedFiles(DeviceLog log, const std::string& file);
    ~PlayedFiles() override;

    /// The ticks begin: the log's time is that of its own start.
    void start();
    /// Whether the log is at its end.
    bool is_over() const;
    /// What differs from the log so far; a line each.
    std::vector<std::string> take_differences();
    /// Compares what is left, as far as it can be: the run is over. Readings that hang come back.
    std::vector<std::string> finish();
    const WriteComparison& comparison() const { return comparison_; }

    Answer<std::unique_ptr<OpenFile>> open(const std::string& path, Access access) override;
    Answer<std::vector<std::string>> list(const std::string& folder) override;
    bool are_real() const override { return false; }

private:
    friend class PlayedFile;
    // The calls of one kind to one path, and which of them was given last.
    struct Track {
        std::vector<const DeviceCall*> calls;
        std::ptrdiff_t given = -1;
    };
    Track& track(DeviceCall::Kind kind, const std::string& path);
    double now() const;
    const DeviceCall* newest(const Track& track) const;
    void wait_for(Lock& lock, const DeviceCall& call);
    Answer<std::size_t> read(DeviceCall::Kind kind, const std::string& path, std::span<char> buffer);
    Answer<std::size_t> write(const std::string& path, std::string_view text);

    const DeviceLog log_;
    mutable Mutex mutex_;
    std::condition_variable over_;
    bool is_finished_ = false;
    double zero_;  // [s] by `clock_seconds`: time 0 of the log
    std::map<std::pair<DeviceCall::Kind, std::string>, Track> tracks_;
    WriteComparison comparison_;
};

}  // namespace nezumi::hw
