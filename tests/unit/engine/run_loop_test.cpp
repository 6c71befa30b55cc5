// The loop of a run: it keeps to the clock, and no pause leaves a real robot driving.
#include "engine/live/run_loop.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "engine/live/robot_buttons.hpp"
#include "tests/unit/engine/fake_world.hpp"
#include "tests/unit/engine/try_component.hpp"

using namespace nezumi;

namespace {

// A mouse whose body is none of a world's, driven at 0.1 m/s by a hand on its in-port.
struct RealLoop {
    explicit RealLoop(HardwareSpec hardware = {}) {
        SystemSpec spec;
        spec.models["mouse"] = fake_mouse();
        spec.models["mouse"].hardware = std::move(hardware);
        RobotEntry entry;
        entry.name = "mouse";
        entry.model = "mouse";
        entry.backend = "driver";
        spec.entries.emplace_back(entry);
        LiveOptions options;
        options.bodies["driver"] = [this](const RobotEntry&,
                                          const RobotSpec& model) -> Expected<std::unique_ptr<RobotBody>> {
            return std::make_unique<FakeBody>(hull, model, not_simulated);
        };
        options.build.real_time = true;
        auto made = RunningSystem::make(std::move(spec), Project::of("behaviors/systems/any.lua"), std::move(options));
        REQUIRE(made);
        live = std::move(*made);
        live->activate();
        REQUIRE(live->act(Hold{"mouse.velocity_in", Velocity2D{.vx = 0.1}}, {}));
    }
    const Robot& robot() const { return *live->system().find_robot("mouse"); }

    FakeHull hull;
    std::unique_ptr<RunningSystem> live;
};

constexpr std::size_t button = 3;  // of the fake mouse's sensors

// Ends the run once this is so.
struct Until final : Attendant {
    Until(RunLoop& its_loop, std::function<bool()> its_condition)
        : loop(its_loop), condition(std::move(its_condition)) {}
    bool serve(Pacer::Clock::time_point) override {
        if (condition()) loop.quit();
        return false;
    }
    RunLoop& loop;
    std::function<bool()> condition;
};

// Runs a loop until then; false when that was not within 20 s.
bool run_until(RunLoop& loop, std::function<bool()> condition) {
    Until until(loop, condition);
    loop.add(until);
    loop.end_at(loop.live().system().now().seconds + 20);
    loop.run();
    return condition();
}

// How far ticks are from the clock, by their numbers.
class Offsets {
public:
    explicit Offsets(double rate) : rate_(rate) {}

    // The tick that has passed was due when it began, less how late it was; after a stall all that follow are due later
    // by that. What comes between its beginning and now, if only the machine, adds to it.
    void add(const Lateness& lateness) {
        const std::chrono::duration<double> passed = Pacer::Clock::now() - begin_;
        const bool stalled = std::exchange(skipped_, lateness.skipped()) != lateness.skipped();
        if (stalled) stalls_ += lateness.latest();
        const double late = stalls_ + (stalled ? 0 : lateness.latest());
        offsets_.push_back(passed.count() - late - static_cast<double>(offsets_.size()) / rate_);
    }
    // The least of some ticks [s]: not all of them were interrupted.
    double least(std::size_t from, std::size_t to) const {
        return *std::min_element(offsets_.begin() + static_cast<std::ptrdiff_t>(from),
                                 offsets_.begin() + static_cast<std::ptrdiff_t>(to));
    }

private:
    double rate_;
    Pacer::Clock::time_point begin_ = Pacer::Clock::now();
    std::uint64_t skipped_ = 0;
    double stalls_ = 0;  // [s]
    std::vector<double> offsets_;
};

}  // namespace

TEST_CASE("1000 Hz asked is 1000 Hz given on average, within 0.1 %", "[engine][run][wallclock]") {
    SystemSpec spec;
    spec.rate = 1000;
    spec.physics_step = 0.001;
    const auto live = RunningSystem::make(std::move(spec), Project::of("behaviors/systems/any.lua"), {});
    REQUIRE(live);
    (*live)->activate();
    RunLoop loop(**live, {});
    Offsets offsets(1000);
    loop.after_tick([&] { offsets.add(loop.lateness()); });
    loop.end_at(4);
    loop.run();
    REQUIRE((*live)->system().now().tick == 4000);
    CHECK(std::abs(offsets.least(3000, 4000) - offsets.least(0, 1000)) < 0.001 * 3);
}

TEST_CASE("a pause of a real robot stops it, and time goes on", "[engine][hardware]") {
    RealLoop run;
    const RunLoop::Options options;
    const auto drives = [&] { return run.hull.speeds.left > 0.05; };
    {
        RunLoop loop(*run.live, options);
        CHECK(loop.is_hardware());
        CHECK(run_until(loop, drives));
    }
    {
        RunLoop loop(*run.live, options);
        loop.pause();
        CHECK(loop.is_paused());
        const auto paused_at = run.live->system().now();
        CHECK(run_until(loop, [&] { return run.hull.speeds == Wheels{}; }));
        CHECK(run.live->system().now().tick > paused_at.tick);
        CHECK(run.live->system().now().seconds > paused_at.seconds);
        CHECK(run.robot().find_out_port("ir")->latched_tick() == run.live->system().now().tick - 1);
    }
    {
        RunLoop loop(*run.live, options);
        loop.pause();
        loop.resume();
        CHECK_FALSE(loop.is_paused());
        CHECK(run_until(loop, drives));
    }
}

TEST_CASE("a robot with a start button stands until it is pressed", "[engine][hardware][safety]") {
    RealLoop run({.start = "button"});
    RunLoop loop(*run.live, {.speed = as_fast_as_possible});
    std::vector<std::string> said;
    const StartButtons buttons(loop, [&](const std::string& line) { said.push_back(line); });
    CHECK(said == std::vector<std::string>{"mouse WAITS: PRESS button ON THE ROBOT, and it starts to move"});
    loop.after_tick([&] {
        if (run.hull.speeds != Wheels{}) loop.quit();
        run.hull.pressed[button] = run.live->system().now().seconds >= 1;
    });
    loop.end_at(20);
    loop.run();
    CHECK(run.live->system().now().seconds > 1);
    CHECK(run.hull.speeds.left > 0);
    CHECK(said.back() == "mouse starts");
}

TEST_CASE("a long press of a robot's shutdown button ends the run", "[engine][hardware]") {
    RealLoop run({.shutdown = "button"});
    RunLoop loop(*run.live, {.speed = as_fast_as_possible});
    std::vector<std::string> said;
    const ShutdownButtons buttons(loop, [&](const std::string& line) { said.push_back(line); });
    loop.after_tick([&] {
        const double now = run.live->system().now().seconds;
        run.hull.pressed[button] = (now > 1 && now < 2) || now > 3;
    });
    loop.end_at(20);
    loop.run();
    CHECK_FALSE(loop.came_to_end());
    CHECK(run.live->system().now().seconds == Approx(6).margin(0.1));
    CHECK(said ==
          std::vector<std::string>{"mouse: button was held for 3 s: the run ends, and the computer is shut down"});
}

TEST_CASE("a program with its own loop runs the ticks that are due, and never waits", "[engine][live][loop]") {
    RealLoop real;
    RunLoop loop(*real.live, {.speed = as_fast_as_possible});
    struct Counted final : Attendant {
        bool serve(Pacer::Clock::time_point) override {
            ++turns;
            return false;
        }
        int turns = 0;
    } counted;
    loop.add(counted);
    CHECK(loop.go_on(0.005) == 0);
    CHECK(counted.turns == 1);
    CHECK(real.live->system().now().tick > 0);

    loop.set_speed(1);
    const double wait = loop.go_on(0.005);
    CHECK(wait >= 0);
    CHECK(wait <= RunLoop::longest_wait);

    loop.end_at(real.live->system().now().seconds);
    const auto tick = real.live->system().now().tick;
    CHECK(loop.go_on(0.005) < 0);
    CHECK(real.live->system().now().tick == tick);
}
