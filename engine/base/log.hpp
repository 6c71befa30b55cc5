// Log lines: severity, time, component and text.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace nezumi {

enum class LogLevel { debug, info, warn, error };

/// "debug", "info", "warn", "error".
std::string_view to_text(LogLevel level);

struct LogLine {
    LogLevel level = LogLevel::info;
    double seconds = 0;     ///< [s] time of the system: simulated, or by the clock if robots are real
    std::string component;  ///< name of the component, or "" for the system itself
    std::string text;
    int start = 1;  ///< number of starts of the system: 1 at first, one more with each restart
    bool operator==(const LogLine&) const = default;
};

/// A function that receives log lines. Called from the ticking thread.
using LogSink = std::function<void(const LogLine&)>;

}  // namespace nezumi
