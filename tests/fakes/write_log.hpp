// What was written to fake nodes, and when.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

namespace nezumi::fakes {

struct Write {
    double at;  ///< [s] by the monotonic clock
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
