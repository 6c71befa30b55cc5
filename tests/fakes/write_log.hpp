// What was written to fake nodes, and when.
#pragma once

#include <fmt/format.h>

#include <chrono>
#include <string>
#include <vector>

namespace nezumi::fakes {

/// The monotonic clock [s].
inline double clock_now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Write {
    double at;  ///< [s] by `clock_now`
    std::string node, text;
    int result;  ///< as the driver returned it: bytes taken, or -errno
};

/// A line each: time, node, 'text', result.
inline std::string listed(const std::vector<Write>& log) {
    std::string text;
    for (const Write& write : log)
        text += fmt::format("{:.6f} {} '{}' {}\n", write.at, write.node, write.text, write.result);
    return text;
}

}  // namespace nezumi::fakes
