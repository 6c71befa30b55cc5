// A system: phases of a tick, wiring and its errors, several of them, with any number of threads.
#include "engine/system/system.hpp"

#include <catch2/catch.hpp>

#include "engine/trace/trace_hash.hpp"
#include "tests/unit/engine/fake_world.hpp"
#include "tests/unit/engine/try_component.hpp"

using namespace nezumi;

namespace {

using Names = std::vector<std::string>;

// Adds a component and activates it.
TryComponent& add(System& system, std::string name, TryComponent::Hooked executed = nullptr) {
    auto made = std::make_unique<TryComponent>(std::move(name));
    TryComponent& it = *made;
    it.executed = std::move(executed);
    REQUIRE(system.add(std::move(made)));
    REQUIRE(it.activate(system.now()));
    return it;
}

std::string refusal(const Expected<void>& result) { return result ? "" : result.error().message; }

// A device that tells the number of the tick.
class Counter final : public Device {
public:
    explicit Counter(std::string name = "counter") : Device(std::move(name), "Counter") {}
    void sense(const Time& now) override { out.write(static_cast<std::int32_t>(now.tick)); }
    void actuate(const Time&) override { acted.push_back(in.read()); }
    OutPort<std::int32_t>& out = add_out_port<std::int32_t>("out");
    InPort<std::int32_t>& in = add_in_port<std::int32_t>("in");
    std::vector<std::int32_t> acted;
};

}  // namespace

TEST_CASE("sensors, behaviours, actuators: a tick goes one way", "[engine][system]") {
    System system({}, nullptr);
    auto made = std::make_unique<Counter>();
    Counter& counter = *made;
    add(system, "follower", [](TryComponent& self) -> Expected<void> {
        self.out.write(10 * self.in.read());
        return {};
    });
    REQUIRE(system.add(std::move(made)));  // after the behaviour: devices' phases do not depend on it
    REQUIRE(system.connect("counter.out", "follower.in"));
    REQUIRE(system.connect("follower.out", "counter.in"));
    for (int i = 0; i < 4; ++i) system.tick();
    CHECK(counter.acted == std::vector<std::int32_t>{0, 10, 20, 30});
}

TEST_CASE("the values that a behaviour reads do not depend on the order in which behaviours run", "[engine][system]") {
    const auto run = [](bool reader_first) {
        System system({}, nullptr);
        std::vector<std::int32_t> seen;
        const auto add_reader = [&] {
            add(system, "reader", [&seen](TryComponent& self) -> Expected<void> {
                seen.push_back(self.in.is_new() ? self.in.read() : -1);
                return {};
            });
        };
        if (reader_first) add_reader();
        add(system, "writer", [](TryComponent& self) -> Expected<void> {
            self.out.write(static_cast<std::int32_t>(self.now().tick));
            return {};
        });
        if (!reader_first) add_reader();
        REQUIRE(system.connect("writer.out", "reader.in"));
        for (int i = 0; i < 4; ++i) system.tick();
        return seen;
    };
    CHECK(run(true) == std::vector<std::int32_t>{-1, 0, 1, 2});  // behaviour to behaviour takes one tick
    CHECK(run(false) == run(true));
}

TEST_CASE("a component executes in the ticks in which it is due, and misses nothing that is queued",
          "[engine][system]") {
    System system({}, nullptr);
    std::vector<std::int64_t> ticks;
    std::vector<std::int32_t> got;
    TryComponent& slow = add(system, "slow", [&](TryComponent& self) -> Expected<void> {
        ticks.push_back(self.now().tick);
        while (self.queue.is_new()) got.push_back(self.queue.read());
        return {};
    });
    slow.rate = 50;
    add(system, "writer", [](TryComponent& self) -> Expected<void> {
        self.out.write(static_cast<std::int32_t>(self.now().tick));
        return {};
    });
    REQUIRE(system.connect("writer.out", "slow.queue"));
    for (int i = 0; i < 7; ++i) system.tick();
    CHECK(ticks == std::vector<std::int64_t>{0, 2, 4, 6});
    CHECK(got == std::vector<std::int32_t>{0, 1, 2, 3, 4, 5});
}

TEST_CASE("a connection is refused with both types and the nearest name", "[engine][system][connect]") {
    FakeRun run;
    System& system = run.system;
    add(system, "controller");
    const auto connect = [&](const char* from, const char* to) { return refusal(system.connect(from, to)); };
    CHECK(connect("mouse.ir", "controller.in") ==
          "types differ: mouse.ir is TimedShortSeq, controller.in is TimedLong");
    CHECK(connect("controller.out", "mouse.velocity_in") ==
          "types differ: controller.out is TimedLong, mouse.velocity_in is TimedVelocity2D (did you mean "
          "'controller.speed'?)");
    CHECK(connect("mouse.velocity", "mouse.pose_in") ==
          "types differ: mouse.velocity is TimedVelocity2D, mouse.pose_in is TimedPose2D (did you mean "
          "'mouse.velocity_in'?)");
    CHECK(connect("controler.out", "mouse.velocity_in") ==
          "'controler.out': there is no component 'controler' (did you mean 'controller'?)");
    CHECK(connect("controller.sped", "mouse.velocity_in") ==
          "controller has no out-port 'sped' (did you mean 'speed'?)");
    CHECK(connect("controller.speed", "mouse.velocity_on") ==
          "mouse has no in-port 'velocity_on' (did you mean 'velocity_in'?)");
    CHECK(connect("controller.x", "mouse.velocity_in") == "controller has no out-port 'x'; it has out, speed, tone");
    CHECK(connect("mouse.velocity_in", "controller.speed") ==
          "connect goes from an out-port to an in-port: mouse.velocity_in (TimedVelocity2D) is an in-port, "
          "controller.speed (TimedVelocity2D) is an out-port (did you mean connect(\"controller.speed\", "
          "\"mouse.velocity_in\")?)");
    CHECK(connect("controller.out", "controller.speed") ==
          "connect goes from an out-port to an in-port: controller.out (TimedLong) is an out-port, controller.speed "
          "(TimedVelocity2D) is an out-port (did you mean 'controller.in'?)");
    CHECK(connect("controller.speed", "controller.speed") ==
          "connect goes from an out-port to an in-port: controller.speed (TimedVelocity2D) is an out-port, "
          "controller.speed (TimedVelocity2D) is an out-port");
    for (const char* path : {"controller", ".out", "controller.", ""}) {
        CHECK(connect(path, "mouse.velocity_in") ==
              "'" + std::string(path) + "' is not a port: expected \"name.port\"");
    }
    // Names come from journals and consoles too: a message stays one line that a terminal can show.
    CHECK(connect("con\nsole", "mouse.velocity_in") == "'con\\x0asole' is not a port: expected \"name.port\"");
    CHECK(connect("a\x1b[2J.out", "mouse.velocity_in") == "'a\\x1b[2J.out': there is no component 'a\\x1b[2J'");
    CHECK(connect("controller.\n", "mouse.velocity_in") ==
          "controller has no out-port '\\x0a'; it has out, speed, tone");
    REQUIRE(system.connect("controller.speed", "mouse.velocity_in"));
    CHECK(connect("controller.speed", "mouse.velocity_in") ==
          "controller.speed is connected to mouse.velocity_in already");
    CHECK(system.connections().size() == 1);
}

TEST_CASE("a robot's in-port that several feed is warned about once", "[engine][system][connect]") {
    FakeRun run;
    for (const char* name : {"a", "b", "c"}) {
        add(run.system, name);
        REQUIRE(run.system.connect(std::string(name) + ".speed", "mouse.velocity_in"));
    }
    CHECK(run.log == Names{": mouse.velocity_in has several connections: the last one in the order of the connect "
                           "lines wins (reported once)"});
    REQUIRE(run.system.connect("a.out", "b.in"));
    REQUIRE(run.system.connect("c.out", "b.in"));
    CHECK(run.log.size() == 1);
}

TEST_CASE("of several commands in one tick the last in the order of the connect lines wins",
          "[engine][system][connect]") {
    for (const bool slow_last : {false, true}) {
        FakeRun run;
        for (const auto& [name, speed] : {std::pair{"slow", 0.1}, std::pair{"fast", 0.3}}) {
            add(run.system, name, [speed = speed](TryComponent& self) -> Expected<void> {
                self.speed.write({.vx = speed});
                return {};
            });
        }
        REQUIRE(run.system.connect(slow_last ? "fast.speed" : "slow.speed", "mouse.velocity_in"));
        REQUIRE(run.system.connect(slow_last ? "slow.speed" : "fast.speed", "mouse.velocity_in"));
        run.ticks(50);
        CHECK(run.hull().speeds.left == Approx(slow_last ? 0.1 : 0.3));
    }
}

TEST_CASE("both ends of a connection list each other as peers, and a connection can be cut",
          "[engine][system][connect]") {
    System system({}, nullptr);
    add(system, "a");
    add(system, "b");
    REQUIRE(system.connect("a.out", "b.in"));
    REQUIRE(system.connect("a.out", "b.queue"));
    CHECK(system.peers(**system.port("a.out")) == Names{"b.in", "b.queue"});
    CHECK(system.peers(**system.port("b.in")) == Names{"a.out"});
    CHECK(refusal(system.disconnect("a.out", "a.in")) == "a.out is not connected to a.in");
    CHECK(refusal(system.disconnect("a.out", "b.inn")) == "b has no port 'inn' (did you mean 'in'?)");
    REQUIRE(system.disconnect("a.out", "b.in"));
    CHECK(system.peers(**system.port("a.out")) == Names{"b.queue"});
    const auto dropped = system.disconnect_all(**system.port("a.out"));
    REQUIRE(dropped.size() == 1);
    CHECK(dropped[0].from == "a.out");
    CHECK(dropped[0].to == "b.queue");
    CHECK(system.connections().empty());
}

TEST_CASE("a connection that is made again has its former place", "[engine][system][connect]") {
    System system({}, nullptr);
    for (const char* name : {"a", "b", "c", "sink"}) add(system, name);
    for (const char* from : {"a.out", "b.out", "c.out"}) REQUIRE(system.connect(from, "sink.in"));
    const std::string gone = GENERATE("a.out", "b.out", "c.out");
    const auto dropped = system.disconnect_all(**system.port(gone));
    REQUIRE(dropped.size() == 1);
    REQUIRE(system.connect_again(dropped[0]));
    CHECK(system.peers(**system.port("sink.in")) == Names{"a.out", "b.out", "c.out"});
    const auto sources = dynamic_cast<InPortBase&>(**system.port("sink.in")).sources();
    REQUIRE(sources.size() == 3);
    CHECK(sources[0] == *system.port("a.out"));
    CHECK(sources[1] == *system.port("b.out"));
    CHECK(sources[2] == *system.port("c.out"));
    REQUIRE(system.connect("a.out", "sink.queue"));
    CHECK(system.connections().back().to == "sink.queue");
}

TEST_CASE("a companion that came with a connection is among the peers, and can be connected by itself",
          "[engine][system][connect]") {
    struct Camera : TryComponent {
        Camera() : TryComponent("from") { out.set_companion(other); }
        OutPort<std::int32_t>& other = add_out_port<std::int32_t>("other");
    };
    System system({}, nullptr);
    REQUIRE(system.add(std::make_unique<Camera>()));
    TryComponent& to = add(system, "to");
    to.in.set_companion(to.queue);
    REQUIRE(system.connect("from.out", "to.in"));
    CHECK(system.peers(**system.port("from.other")) == Names{"to.queue"});
    CHECK(system.peers(**system.port("to.queue")) == Names{"from.other"});
    REQUIRE(system.connect("from.other", "to.queue"));
    CHECK(system.peers(**system.port("to.queue")) == Names{"from.other"});
    CHECK(system.connect("from.other", "to.queue").error().message == "from.other is connected to to.queue already");
    REQUIRE(system.disconnect("from.out", "to.in"));
    CHECK(system.peers(**system.port("to.queue")) == Names{"from.other"});
    CHECK(dynamic_cast<InPortBase&>(**system.port("to.queue")).connected());
}

TEST_CASE("a component can't have a name that is taken, no identifier or a word of the console", "[engine][system]") {
    System system({}, nullptr);
    add(system, "it");
    const auto refused = [&](std::string name, double rate = 0, int line = 0) {
        auto made = std::make_unique<TryComponent>(std::move(name));
        made->rate = rate;
        made->place.line = line;
        const auto added = system.add(std::move(made));
        return added ? "" : added.error().message;
    };
    CHECK(refused("it") == "the name 'it' is given twice");
    CHECK(refused("pause") == "'pause' is a command of the console: choose another name");
    for (const char* name : {"", "2nd", "a-b", "a b", "end", "m\xC3\xA4use", "a.b"}) {
        CHECK(refused(name) == "'" + std::string(name) +
                                   "' is not a valid name: expected letters, digits and _, not beginning with a digit, "
                                   "and no keyword of Lua");
    }
    CHECK(refused("quick", 101) == "quick: a rate of 101 Hz is above the tick's 100 Hz");
    CHECK(refused("back", -1) == "back: expected a rate above 0 Hz, or 0 for the tick's, got -1");
    CHECK(refused("same", 100, 7).empty());
    CHECK(refused("same") == "the name 'same' is given twice, first in line 7");
    CHECK(system.components().size() == 2);
}

TEST_CASE("a component that is removed lets its safe values through and is gone", "[engine][system]") {
    System system({}, nullptr);
    add(system, "driver", [](TryComponent& self) -> Expected<void> {
        self.speed.write({.vx = 0.3});
        return {};
    });
    class Wheels final : public Device {
    public:
        Wheels() : Device("wheels", "Wheels") {}
        void sense(const Time&) override {}
        void actuate(const Time&) override { speed = in.read().vx; }
        InPort<Velocity2D>& in = add_in_port<Velocity2D>("in");
        double speed = -1;
    };
    auto made = std::make_unique<Wheels>();
    const Wheels& wheels = *made;
    REQUIRE(system.add(std::move(made)));
    REQUIRE(system.connect("driver.speed", "wheels.in"));
    system.tick();
    CHECK(wheels.speed == 0.3);
    REQUIRE(system.remove("driver"));
    system.tick();
    CHECK(wheels.speed == 0);
    CHECK(system.find("driver") == nullptr);
    CHECK(system.connections().empty());
    CHECK_FALSE(wheels.in.connected());
    CHECK(refusal(system.remove("driver")) == "there is no component 'driver'");
    add(system, "driver");
}

TEST_CASE("a system that stops deactivates everything, last first, and lets the robots brake", "[engine][system]") {
    FakeRun run;
    Names order;
    for (const char* name : {"first", "second"}) {
        add(run.system, name).deactivated = [&order](TryComponent& self) -> Expected<void> {
            order.push_back(self.name());
            return {};
        };
    }
    for (int i = 0; i < 50; ++i) run.send("velocity_in", Velocity2D{.vx = 0.5});
    run.system.stop(30);
    CHECK(order == Names{"second", "first"});
    CHECK(run.robot->state() == LifeState::inactive);
    CHECK(run.hull().speeds == nezumi::Wheels{});
    for (std::size_t i = 1; i < run.hull().all_speeds.size(); ++i) {
        CHECK(std::abs(run.hull().all_speeds[i].left - run.hull().all_speeds[i - 1].left) < 0.0201);
    }
}

TEST_CASE("an error is the component's own: the others go on", "[engine][system]") {
    System system({}, nullptr);
    add(system, "bad", [](TryComponent&) -> Expected<void> { return failure("no"); });
    TryComponent& good = add(system, "good");
    for (int i = 0; i < 3; ++i) system.tick();
    CHECK(system.find("bad")->state() == LifeState::error);
    CHECK(good.executions() == 3);
    CHECK_FALSE(system.fatal_error());
}

TEST_CASE("running out of time ends a run where that was asked for, whichever hook it was", "[engine][system]") {
    const auto out_of_time = [](TryComponent&) -> Expected<void> {
        return Unexpected(Error{"used up its budget", {}, Error::Kind::out_of_time});
    };
    for (const bool fatal : {false, true}) {
        System system({.out_of_time_is_fatal = fatal}, nullptr);
        add(system, "slow", out_of_time);
        system.tick();
        CHECK(system.fatal_error().has_value() == fatal);
    }
    System system({.out_of_time_is_fatal = true}, nullptr);
    TryComponent& rare = add(system, "rare");
    rare.rate = 0.1;
    system.tick();
    rare.deactivated = out_of_time;
    CHECK_FALSE(rare.deactivate(system.now()));
    system.tick();
    CHECK(system.fatal_error() == rare.last_error());
}

TEST_CASE("a timeout on the way to ERROR also ends a headless run, although another error came first",
          "[engine][system]") {
    System system({.out_of_time_is_fatal = true}, nullptr);
    TryComponent& slow = add(system, "slow", [](TryComponent&) -> Expected<void> { return failure("no"); });
    slow.aborting = [](TryComponent&) -> Expected<void> {
        return Unexpected(Error{"used up its budget", {}, Error::Kind::out_of_time});
    };
    system.tick();
    CHECK(slow.last_error().message == "no");
    REQUIRE(system.fatal_error());
    CHECK(system.fatal_error()->message == "used up its budget");
}
