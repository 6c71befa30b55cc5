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
    double seconds = 0;     ///< [s] time of the system: simulated, or of the clock where robots are real
    std::string component;  ///< its name, or "" for the system itself
    std::string text;
    int start = 1;  ///< number of the system's start: 1, and one more with each restart
};

/// Where log lines go. Called from the thread that ticks.
using LogSink = std::function<void(const LogLine&)>;

}  // namespace nezumi
