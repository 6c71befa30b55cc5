// A device log: each access of a driver to a device with its time and result, one per line.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi::hw {

/// One access of a driver.
struct DeviceCall {
    enum class Kind {
        open_read,   ///< opened for reading
        open_write,  ///< opened for writing
        read,
        write,
        list,  ///< listed a folder
        keys,  ///< read the pressed keys of an event device
    };
    Kind kind = Kind::read;
    std::string path;  ///< begins with /dev or /sys, even if the run used other folders instead
    double begin = 0;  ///< [s] since the start of the run
    double took = 0;   ///< [s] duration; infinite: the call did not return
    int error = 0;     ///< an errno; 0: none
    /// The text that was read or written, or the names of a folder with a '
    /// ' after each. A written text longer than `longest_text` is replaced by its `fingerprint`.
    std::string text;
    std::size_t bytes = 0;  ///< number of bytes that the device accepted
    int line = 0;           ///< line in the log's file

    double end() const { return begin + took; }
    bool operator==(const DeviceCall&) const = default;
};

inline constexpr std::size_t longest_text = 1024;  ///< [bytes]

/// Replaces a long text: "#LENGTH:HASH", 64 bits of FNV-1a.
std::string fingerprint(std::string_view text);

/// The kind's name in a log: "read".
std::string_view name_of(DeviceCall::Kind kind);

/// The first lines of a log.
std::string device_log_header();
/// A call as a line with a line end.
std::string to_line(const DeviceCall& call);
/// The line for the start of the ticks at `when` [s].
std::string start_line(double when);
/// The line for the end of the run at `when` [s]; later lines show how the robots were stopped.
std::string end_line(double when);

struct DeviceLog {
    std::vector<DeviceCall> calls;  ///< in the order of the file: the call that returned first is first
    double start = 0;               ///< [s] start of the ticks
    double length = 0;              ///< [s] end of the run; of an incomplete log: the end of its last call
    bool is_torn = false;           ///< the last line is incomplete and left out
};

/// Reads a device log. An error gives the line, what it contains and what was expected.
Expected<DeviceLog> read_device_log(std::string_view text, const std::string& file);

}  // namespace nezumi::hw
