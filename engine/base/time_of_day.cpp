// The system's own clock.
#include "engine/base/time_of_day.hpp"

#include <chrono>

namespace nezumi {

double time_of_day() {
    return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

}  // namespace nezumi
