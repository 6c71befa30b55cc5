// Messages between two processes by Cyclone DDS on the loopback: there and back, and how many a second.
#include <sys/wait.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <vector>

#include "bindings/dds/cyclone.hpp"
#include "bindings/dds/domain_xml.hpp"
#include "tests/bench/report.hpp"

using namespace nezumi;
using namespace nezumi::dds;

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint32_t domain = 197;
constexpr std::size_t small = 32;                    // [bytes] of a velocity with its head
constexpr std::size_t picture = 640 * 480 * 3 + 64;  // [bytes]

Topic topic_of(const char* name) { return {.name = name, .type = "nezumi::Octets", .reliable = true, .depth = 128}; }

std::unique_ptr<DdsTransport> join() {
    auto place = open_cyclone({.domain = domain, .xml = domain_xml("", {})});
    if (place) return std::move(*place);
    std::fprintf(stderr, "%s\n", place.error().message.c_str());
    std::exit(1);
}

Octets cdr(std::size_t size) {
    Octets bytes(size, 0);
    bytes[1] = 1;
    return bytes;
}

// The other process: sends back what comes, until it is killed.
[[noreturn]] void echo() {
    const auto place = join();
    const auto reader = place->read(topic_of("bench/there"));
    const auto writer = place->write(topic_of("bench/back"));
    for (;;) {
        for (const TopicSample& sample : reader->take()) writer->write(sample.bytes);
    }
}

struct Ends {
    std::unique_ptr<Writer> there;
    std::unique_ptr<Reader> back;

    // [s] there and back; both ends look without a pause.
    double pass(const Octets& bytes) const {
        const auto begin = Clock::now();
        there->write(bytes);
        for (;;) {
            if (!back->take().empty()) return std::chrono::duration<double>(Clock::now() - begin).count();
        }
    }
};

void round_trips(const Ends& ends, std::size_t size, int count) {
    const Octets bytes = cdr(size);
    std::vector<double> times;
    for (int i = 0; i < count; ++i) times.push_back(ends.pass(bytes));
    std::sort(times.begin(), times.end());
    const auto at = [&](double part) { return 1e6 * times[static_cast<std::size_t>(part * (count - 1))]; };
    std::printf("%7zu bytes there and back: p50 %.0f us, p99 %.0f us of %d\n", size, at(0.5), at(0.99), count);
}

// So many on their way that none is dropped.
void messages_a_second(const Ends& ends, std::size_t size, int on_the_way, double seconds) {
    const Octets bytes = cdr(size);
    int sent = 0, returned = 0;
    const auto begin = Clock::now();
    const auto passed = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
    while (passed() < seconds) {
        for (; sent - returned < on_the_way; ++sent) ends.there->write(bytes);
        returned += static_cast<int>(ends.back->take().size());
    }
    std::printf("%7zu bytes: %.0f a second each way\n", size, returned / passed());
}

}  // namespace

int main() {
    bench::print_header("messages between two processes",
                        "reliable, on the loopback; both processes look without a pause");
    const pid_t other = fork();
    if (other == 0) echo();
    const auto place = join();
    const Ends ends{place->write(topic_of("bench/there")), place->read(topic_of("bench/back"))};
    while (ends.there->readers() == 0 || ends.back->writers().empty()) usleep(1000);
    for (int i = 0; i < 100; ++i) ends.pass(cdr(small));
    round_trips(ends, small, 20'000);
    round_trips(ends, picture, 300);
    messages_a_second(ends, small, 64, 3);
    messages_a_second(ends, picture, 2, 3);
    kill(other, SIGKILL);
    waitpid(other, nullptr, 0);
}
