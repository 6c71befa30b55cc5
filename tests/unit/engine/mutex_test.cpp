// What keeps a thread with a real-time priority from waiting for one that gets no processor.
#include "engine/base/mutex.hpp"

#include <sched.h>
#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>

using namespace nezumi;

namespace {

// As the kernel shows it: 20 for most, less than 0 for SCHED_FIFO. The 18th field, after a name that may have blanks.
int priority_of(pid_t thread) {
    std::ifstream file("/proc/self/task/" + std::to_string(thread) + "/stat");
    std::string text;
    std::getline(file, text);
    text.erase(0, text.rfind(')') + 1);
    int field = 2;
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (text[at] == ' ' && ++field == 18) return std::stoi(text.substr(at));
    }
    return 0;
}

}  // namespace

TEST_CASE("the holder of a mutex inherits the priority of a waiting thread", "[engine][mutex]") {
    const int before = priority_of(gettid());
    Mutex mutex;
    std::atomic<bool> may = true;
    std::thread waits;
    int seen = before;
    {
        const Lock lock(mutex);
        waits = std::thread([&] {
            const sched_param parameters{.sched_priority = 1};
            may = sched_setscheduler(0, SCHED_FIFO, &parameters) == 0;
            if (may) const Lock waited(mutex);
        });
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        while (seen == before && may && std::chrono::steady_clock::now() < end) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            seen = priority_of(gettid());
        }
    }
    waits.join();
    if (!may) throw std::runtime_error("SKIPPED: SCHED_FIFO is not allowed here");
    CHECK(seen == -2);  // that of SCHED_FIFO 1
    CHECK(priority_of(gettid()) == before);
}
