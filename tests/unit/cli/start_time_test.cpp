// What a start of the program costs.
#include <sys/resource.h>

#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/lua/machine_speed.hpp"

using namespace nezumi;

namespace {

// CPU time of all programs that were run to their end [s]: on an idle machine the time that they took. Busy neighbours,
// who have a program wait for its turn, are not in it.
double time_of_programs() {
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace

TEST_CASE("nezumi types TimedLong takes less than 30 ms from its start to its end", "[cli][types][wallclock]") {
    double slowest = slowness(), best = 1e9;
    for (int start = 0; start < 10; ++start) {
        const double before = time_of_programs();
        REQUIRE(run_nezumi({"types", "TimedLong"}).status == 0);
        best = std::min(best, time_of_programs() - before);
    }
    slowest = std::max(slowest, slowness());
    CAPTURE(best, slowest);
    CHECK(best < 0.03 * slowest);
}
