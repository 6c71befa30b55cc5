// What it costs to write and read a message as CDR: a velocity, and a picture beside a bare copy of it.
#include <algorithm>
#include <cstdio>
#include <cstring>

#include "engine/ports/messages.hpp"
#include "engine/values/cdr.hpp"
#include "tests/bench/report.hpp"

using namespace nezumi;

namespace {

// The least of several rounds, in ns for one call.
template <class Work>
double nanoseconds(int calls, const Work& work) {
    double best = 1e300;
    for (int round = 0; round < 15; ++round) {
        best = std::min(best, bench::time_of([&] {
                                  for (int i = 0; i < calls; ++i) work(i);
                              }) / calls *
                                  1e9);
    }
    return best;
}

template <Payload T>
void measure(const char* name, int calls, const T& data) {
    Octets stream;
    T got{};
    double tm = 0;
    double sum = 0;
    const double write = nanoseconds(calls, [&](int i) { write_cdr_message(stream, data, i * 0.01); });
    const double read = nanoseconds(calls, [&](int) {
        if (read_cdr_message(stream, got, tm)) sum += tm;
    });
    Octets copy(stream.size());
    const double copied = nanoseconds(calls, [&](int i) {
        stream[0] = static_cast<std::uint8_t>(i);
        std::memcpy(copy.data(), stream.data(), stream.size());
        asm volatile("" : : "r"(copy.data()) : "memory");  // or the copies would be left out
    });
    std::printf("%-26s %7zu bytes: write %9.1f ns, read %9.1f ns, memcpy %9.1f ns%s\n", name, stream.size(), write,
                read, copied, got == data && sum > 0 ? "" : " (lost!)");
}

}  // namespace

int main() {
    bench::print_header("CDR, one message", "little-endian, no header; the best of 15 rounds, CPU time");
    measure("TimedVelocity2D", 200'000, Velocity2D{.vx = 0.1, .va = 0.2});
    measure("TimedShortSeq, 4 values", 200'000, std::vector<std::int16_t>{1, 2, 3, 4});
    measure("CameraImage, 640x480 rgb8", 200,
            CameraImage{.width = 640, .height = 480, .bpp = 24, .format = "rgb8", .pixels = Octets(640 * 480 * 3, 7)});
    return 0;
}
