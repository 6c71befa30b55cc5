// Threads of devices: waking, abandoning, and the samples for the loop.
#include "hw/device/worker.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "hw/device/sampler.hpp"

using namespace nezumi::hw;

namespace {

void pause_for(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

bool soon(const std::function<bool()>& is_so) {
    for (int i = 0; i < 5000 && !is_so(); ++i) pause_for(0.001);
    return is_so();
}

// Counts its calls, and hangs on request.
struct CountingJob final : DeviceJob {
    struct Seen {
        std::atomic<int> runs = 0;
        std::atomic<bool> hang = false, ended = false, gone = false;
    };
    explicit CountingJob(Seen& its_seen) : seen(its_seen) {}
    ~CountingJob() override { seen.gone = true; }
    double run() override {
        ++seen.runs;
        while (seen.hang) pause_for(0.001);
        return 1000;
    }
    void end() override { seen.ended = true; }
    Seen& seen;
};

// Answers with a growing number, or not.
struct Thermometer final : Sampler<int> {
    Thermometer() : Sampler("thermometer", 0.001) {}
    tl::expected<std::optional<int>, std::string> sample(double) override {
        while (hang) pause_for(0.001);
        if (broken) return tl::unexpected(std::string("its wire is cut: solder it"));
        return ++value;
    }
    int value = 0;
    std::atomic<bool> broken = false, hang = false;
};

}  // namespace

TEST_CASE("a device's thread works when it is woken, and once more at the end", "[hw][device]") {
    CountingJob::Seen seen;
    {
        const RunningJob job(std::make_unique<CountingJob>(seen));
        CHECK(soon([&] { return seen.runs == 1; }));
        job.wake();
        CHECK(soon([&] { return seen.runs == 2; }));
        CHECK_FALSE(seen.ended);
    }
    CHECK(seen.ended);
    CHECK(seen.gone);
}

TEST_CASE("a device's thread that hangs is abandoned with all that it uses", "[hw][device][threads][wallclock]") {
    CountingJob::Seen seen;
    seen.hang = true;
    const double before = clock_seconds();
    const CountingJob* left_behind = nullptr;
    {
        const RunningJob job(std::make_unique<CountingJob>(seen));
        left_behind = job.operator->();
        REQUIRE(soon([&] { return seen.runs == 1; }));
    }
    CHECK(clock_seconds() - before < DeviceWorker::patience + 0.5);
    CHECK(left_behind->hangs(clock_seconds()));
    CHECK_FALSE(seen.ended);
    CHECK_FALSE(seen.gone);
    seen.hang = false;
    CHECK(soon([&] { return seen.gone.load(); }));
    CHECK(seen.ended);
}

TEST_CASE("the loop gets a device's newest sample, but not an old one", "[hw][device][wallclock]") {
    const RunningJob device(std::make_unique<Thermometer>());
    REQUIRE(soon([&] { return device->newest(clock_seconds()) && device->newest(clock_seconds())->value > 3; }));
    const auto sample = device->newest(clock_seconds());
    REQUIRE(sample);
    CHECK(clock_seconds() - sample->tm < 0.2);
    CHECK_FALSE(device->newest(clock_seconds() + 1));
    CHECK(device->take_faults().empty());
}

TEST_CASE("a device that fails or hangs is reported once and used again", "[hw][device][threads][wallclock]") {
    const RunningJob device(std::make_unique<Thermometer>());
    device->broken = true;
    std::vector<std::string> told;
    const auto listen = [&] {
        device->newest(clock_seconds());
        for (std::string& line : device->take_faults()) told.push_back(std::move(line));
        return !told.empty();
    };
    REQUIRE(soon(listen));
    pause_for(0.7);
    listen();
    CHECK(told == std::vector<std::string>{"thermometer: its wire is cut: solder it"});
    told.clear();
    device->broken = false;
    REQUIRE(soon(listen));
    CHECK(told == std::vector<std::string>{"thermometer: back again"});
    told.clear();
    device->hang = true;
    REQUIRE(soon(listen));
    CHECK(told == std::vector<std::string>{"thermometer: no answer for 0.3 s: restart its driver, or the robot"});
    device->hang = false;
    told.clear();
    REQUIRE(soon(listen));
    CHECK(told == std::vector<std::string>{"thermometer: back again"});
}

TEST_CASE("a job's resources are free after the end of its worker", "[hw][worker]") {
    struct Holder final : DeviceJob {
        explicit Holder(bool& its_flag) : is_held(its_flag) { is_held = true; }
        ~Holder() override { is_held = false; }
        double run() override { return 1; }
        bool& is_held;
    };
    for (int i = 0; i < 200; ++i) {
        bool is_held = false;
        { const RunningJob job(std::make_unique<Holder>(is_held)); }
        REQUIRE_FALSE(is_held);
    }
}
