// The engine's side of the process that writes to a device.
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

/// If the engine ends for any reason, the process sends the safe bytes. If the engine stalls, the process misses its
/// beats and does the same. Nothing is guaranteed if both are killed at the same time. No function blocks. Any thread
/// may call them.
class DeviceWriter {
public:
    /// Forks the process, without a device at first. Call it on the program's main thread: when the calling thread
    /// ends, the process stops the device. Fails if it could not outlive this process: as process 1 of a container.
    static Expected<std::unique_ptr<DeviceWriter>> start(Lease lease);
    /// The process sends the safe bytes once more and ends.
    ~DeviceWriter();
    DeviceWriter(const DeviceWriter&) = delete;
    DeviceWriter& operator=(const DeviceWriter&) = delete;

    /// Gives it the device that it writes to from now on; it gets duplicates of its files. `end`: ends a torn message.
    /// Returns an `errno`, or 0.
    int give(const WriteTarget& target, const std::string& end, const std::string& safe) const;
    void send(std::string_view message) const;
    void beat(double now) const;
    void stop() const;
    /// Stops the device, and closes it: it is lost. Lines of a chip are free for the next `give` then.
    void release() const;

    /// The next answer, and its bytes; nothing if there is none.
    std::optional<std::pair<WriterAnswer, std::string>> take_answer();
    /// The process has ended: it can't stop the device.
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
