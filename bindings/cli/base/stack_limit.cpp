// A behaviour may use 1 MB of the C stack (watchdog.hpp); its callers and libraries need much less than another 1 MB.
#include "bindings/cli/base/stack_limit.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

namespace nezumi::cli {

std::string stack_problem() {
    constexpr rlim_t least = rlim_t{2} << 20;
    rlimit stack{};
    if (getrlimit(RLIMIT_STACK, &stack) != 0 || stack.rlim_cur >= least)
        return "";  // RLIM_INFINITY is the largest value
    return fmt::format("the stack limit is {} kB, at least {} kB are needed: run `ulimit -s 8192` first",
                       stack.rlim_cur >> 10, least >> 10);
}

}  // namespace nezumi::cli
