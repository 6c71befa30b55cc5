// Reads anything as a journal and replays its first ticks: what is wrong with it is an error of one line.
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "bindings/embed/simulation.hpp"
#include "bindings/journal/replay.hpp"
#include "tests/fuzz/require.hpp"

using namespace nezumi;

namespace {

constexpr int most_ticks = 10;

void replay(Replay& journal) {
    LiveOptions options = simulated_systems({});
    options.build.log = [](const LogLine&) {};
    auto live = journal.load(std::move(options));
    if (!live) return require_line(live.error().message);
    (*live)->activate();
    for (int tick = 0; tick < most_ticks; ++tick) {
        const auto more = journal.before_tick(**live);
        if (!more) return require_line(more.error().message);
        if (!*more) return;
        (*live)->tick();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const int file = memfd_create("journal", 0);
    static const std::string name = "/proc/self/fd/" + std::to_string(file);
    require(ftruncate(file, 0) == 0 && pwrite(file, data, size, 0) == static_cast<ssize_t>(size));
    const auto journal = Replay::read(name, "any");
    journal ? replay(**journal) : require_line(journal.error().message);
    return 0;
}
