// Counts that tests/long sets higher than ./test.
#pragma once

#include <cstdlib>

/// The number in an environment variable, or `fallback` if there is no such variable.
inline int number_from_environment(const char* name, int fallback) {
    const char* text = std::getenv(name);
    return text != nullptr ? std::atoi(text) : fallback;
}
