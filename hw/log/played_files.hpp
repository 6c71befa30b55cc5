// Replays a device log as device files, at the times of the log: the drivers run without the robot.
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

/// A read returns the log's next value when its time comes. A driver that reads late gets the newest value; one that
/// reads more often gets the same value again. Calls that failed or hung in the log do so again. Writes are compared
/// with the log. Times are those of `clock_seconds` since construction, or as set by `start`.
class PlayedFiles final : public DeviceFiles, public std::enable_shared_from_this<PlayedFiles> {
public:
    /// `file` is the log's name in messages.
    PlayedFiles(DeviceLog log, const std::string& file);
    ~PlayedFiles() override;

    /// Call it when the ticks start: sets the time of the replay to the start of the ticks in the log.
    void start();
    /// True if the time is after the end of the log.
    bool is_over() const;
    /// Returns the new differences from the log, one line each.
    std::vector<std::string> take_differences();
    /// Ends the replay: compares the rest as far as possible, and lets calls that hang return.
    std::vector<std::string> finish();
    const WriteComparison& comparison() const { return comparison_; }

    Answer<std::unique_ptr<OpenFile>> open(const std::string& path, Access access) override;
    Answer<std::vector<std::string>> list(const std::string& folder) override;
    bool are_real() const override { return false; }

private:
    friend class PlayedFile;
    // The calls of one kind to one path, and the last one used.
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
