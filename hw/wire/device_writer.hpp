// Starts and controls the writer: the process that writes to a device.
#pragma once

#include <sys/types.h>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "engine/base/error.hpp"
#include "hw/guard/lease.hpp"
#include "hw/wire/writer_process.hpp"

namespace nezumi::hw {

/// If the engine ends for any reason, the writer sends the safe bytes to the device. If the engine stalls, its beats
/// are missing, and the writer does the same. Nothing is guaranteed if both are killed at the same time. No function
/// blocks. Any thread may call them.
class DeviceWriter {
public:
    /// Forks the writer, without a device at first. Call it on the program's main thread: when the calling thread ends,
    /// the writer stops the device. Fails if the writer could not outlive this process, because this is process 1 of a
    /// container.
    static Expected<std::unique_ptr<DeviceWriter>> start(Lease lease);
    /// Lets the writer send the safe bytes once more and end.
    ~DeviceWriter();
    DeviceWriter(const DeviceWriter&) = delete;
    DeviceWriter& operator=(const DeviceWriter&) = delete;

    /// Sets the device that the writer writes to from now on; the writer gets duplicates of the files. `end`: the bytes
    /// that end a torn message. Returns an `errno`, or 0.
    int give(const WriteTarget& target, const std::string& end, const std::string& safe) const;
    void send(std::string_view message) const;
    void beat(double now) const;
    void stop() const;
    /// Stops the device and closes it, because it is lost. Then its GPIO lines are free for the next `give`.
    void release() const;

    /// The writer's next answer, and the bytes with it; nothing if there is none.
    std::optional<std::pair<WriterAnswer, std::string>> take_answer();
    /// True if the writer has ended, so that it can't stop the device.
    bool has_ended() const { return has_ended_; }
    pid_t process() const { return process_; }

private:
    DeviceWriter(Lease lease, int socket, pid_t process)
        : lease_(std::move(lease)), socket_(socket), process_(process) {}
    int order(const WriterOrder& order, std::string_view bytes, std::span<const int> files = {}) const;

    Lease lease_;
    int socket_;
    pid_t process_;
    bool has_ended_ = false;
};

}  // namespace nezumi::hw
