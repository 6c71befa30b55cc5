// Reads the clock of the operating system.
#include "engine/base/time_of_day.hpp"

#include <chrono>

namespace nezumi {

double time_of_day() {
    const auto now = std::chrono::system_clock::now();  // the wall clock: RTCs use it for stamps
    return std::chrono::duration<double>(now.time_since_epoch()).count();
}

}  // namespace nezumi
