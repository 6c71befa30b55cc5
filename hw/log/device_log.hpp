// A device log: what drivers asked of their devices, when, and what they got, a line each.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi::hw {

/// One thing that a driver did.
struct DeviceCall {
    enum class Kind {
        open_read,   ///< opened for reading
        open_write,  ///< opened for writing
        read,
        write,
        list,  ///< of a folder
        keys,  ///< of an event device that are down
    };
    Kind kind = Kind::read;
    std::string path;  ///< begins with /dev or /sys, whatever folders stood for them
    double begin = 0;  ///< [s] since the run began
    double took = 0;   ///< [s]; infinite: it never came back
    int error = 0;     ///< an errno; 0: none
    /// Read or written, or the names of a folder with a '\n' after each. Of what was written and is longer than
    /// `longest_text`, its `fingerprint`.
    std::string text;
    std::size_t bytes = 0;  ///< that a device took of what was written
    int line = 0;           ///< in the file

    double end() const { return begin + took; }
    bool operator==(const DeviceCall&) const = default;
};

inline constexpr std::size_t longest_text = 1024;  ///< [bytes]

/// What stands for a long text: "#LENGTH:HASH", 64 bits of FNV-1a.
std::string fingerprint(std::string_view text);

/// "read", and as the others are called in a log.
std::string_view name_of(DeviceCall::Kind kind);

/// What a log begins with.
std::string device_log_header();
/// A call as a line, with its end.
std::string to_line(const DeviceCall& call);
/// The line that says that the system was there, and its ticks began, at `when` [s].
std::string start_line(double when);
/// The line that says that the run ended at `when` [s]: what follows is how the robots were stopped.
std::string end_line(double when);

struct DeviceLog {
    std::vector<DeviceCall> calls;  ///< by the time of their ends, as they were written
    double start = 0;               ///< [s] when the ticks began
    double length = 0;              ///< [s] when the run ended, or was cut off
    bool is_torn = false;           ///< its last line is not whole, and left out
};

/// Reads what was written. An error says the line, what it has and what was expected.
Expected<DeviceLog> read_device_log(std::string_view text, const std::string& file);

}  // namespace nezumi::hw
