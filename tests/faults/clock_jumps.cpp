// Preloaded: the wall clock jumps by an hour, back and forth, ten times a second.
#include <dlfcn.h>
#include <sys/time.h>

#include <ctime>

namespace {

constexpr long jump = 3600;               // [s]
constexpr long period = 100 * 1'000'000;  // [ns]

int real_clock(clockid_t clock, timespec* time) {
    using Clock = int (*)(clockid_t, timespec*);
    static const auto real = reinterpret_cast<Clock>(dlsym(RTLD_NEXT, "clock_gettime"));
    return real(clock, time);
}

}  // namespace

extern "C" {

int clock_gettime(clockid_t clock, timespec* time) noexcept {
    const int result = real_clock(clock, time);
    if (result != 0 || (clock != CLOCK_REALTIME && clock != CLOCK_REALTIME_COARSE)) return result;
    timespec steady{};
    real_clock(CLOCK_MONOTONIC, &steady);
    time->tv_sec += (steady.tv_nsec / period) % 2 == 0 ? jump : -jump;
    return 0;
}

int gettimeofday(timeval* time, void*) noexcept {
    timespec now{};
    clock_gettime(CLOCK_REALTIME, &now);
    *time = {now.tv_sec, now.tv_nsec / 1000};
    return 0;
}

time_t time(time_t* place) noexcept {
    timespec now{};
    clock_gettime(CLOCK_REALTIME, &now);
    if (place != nullptr) *place = now.tv_sec;
    return now.tv_sec;
}

}  // extern "C"
