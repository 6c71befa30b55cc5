// Acts of the engine: checked, then done; holds have owners, and an emergency stop lasts until it is rearmed.
#include <catch2/catch.hpp>
#include <cmath>
#include <type_traits>

#include "engine/system/perform.hpp"
#include "tests/unit/engine/fake_world.hpp"
#include "tests/unit/engine/try_component.hpp"

using namespace nezumi;

namespace {

const Actor console{Actor::Kind::console};
const Actor tablet{Actor::Kind::browser, "tablet"};

template <class Kind>
std::string error_of(System& system, const Kind& act, const Actor& who = console) {
    auto done = perform(system, act, who);
    return done ? "" : describe(done.error());
}

// Drives at 0.1 m/s, held by the console.
struct Driving : FakeRun {
    Driving() {
        REQUIRE(error_of(system, hold(0.1)).empty());
        ticks(20);
        move();
    }
    static Hold hold(double vx, bool take = false) { return {"mouse.velocity_in", Velocity2D{.vx = vx}, take}; }
    double speed() { return (hull().speeds.left + hull().speeds.right) / 2; }
    // The wheels turn as they are told.
    void move(int count = 1) {
        for (; count > 0; --count) {
            hull().angles.left += hull().coasting ? 0 : hull().speeds.left * 0.01 / spec.drive.radius;
            hull().angles.right += hull().coasting ? 0 : hull().speeds.right * 0.01 / spec.drive.radius;
            system.tick();
        }
    }
    const std::string& note() { return robot->find_in_port("velocity_in")->note(); }
};

template <class Any>
constexpr bool can_be_changed = requires(Any& system) {
    system.connect("a.b", "c.d");
}
|| requires(Any& system) { system.find("a")->activate(Time{}); }
|| requires(Any& system) { (*system.port("a.b"))->release(); }
|| requires(Any& system) { (*system.components().begin())->parameters().set("a", true); };

}  // namespace

TEST_CASE("a constant system can't be changed", "[engine][act]") {
    STATIC_REQUIRE(can_be_changed<System>);
    STATIC_REQUIRE_FALSE(can_be_changed<const System>);
}

TEST_CASE("the error about an unknown name in an act has the nearest name", "[engine][act]") {
    FakeRun run;
    CHECK(error_of(run.system, Activate{"mous"}) == "there is no component 'mous' (did you mean 'mouse'?)");
    CHECK(error_of(run.system, Drop{"mouse.velocty_in"}) ==
          "mouse has no port 'velocty_in' (did you mean 'velocity_in'?)");
    CHECK(error_of(run.system, Press{"mouse", "buton"}) == "mouse has no button 'buton' (did you mean 'button'?)");
    CHECK(error_of(run.system, Command{"mouse", "dance", {}}) == "mouse has no command 'dance'");
    CHECK(error_of(run.system, Disconnect{"mouse.ir", ""}) == "mouse.ir is not connected");
}

TEST_CASE("a value that does not fit the port, or is not finite, is refused", "[engine][act]") {
    FakeRun run;
    CHECK(error_of(run.system, Inject{"mouse.velocity_in", 1.0}) ==
          "types differ: mouse.velocity_in is TimedVelocity2D, the value is TimedDouble");
    CHECK(error_of(run.system, Hold{"mouse.velocity_in", Velocity2D{.vx = std::nan("")}}) ==
          "mouse.velocity_in: a number of the value is not finite");
    CHECK(run.system.holder("mouse.velocity_in") == nullptr);
    for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e300}) {
        const auto refused = Catch::StartsWith("disturb: a speed: expected a ");
        CHECK_THAT(error_of(run.system, Disturb{"mouse", bad, {}, {}}), refused);
        CHECK_THAT(error_of(run.system, Disturb{"mouse", 0.1, bad, {}}), refused);
        CHECK_THAT(error_of(run.system, Disturb{"mouse", {}, {}, bad}), refused);
    }
    CHECK(error_of(run.system, Disturb{"mouse", 0.1, {}, -0.5}).empty());
}

TEST_CASE("a robot without buttons can't be pressed", "[engine][act]") {
    RobotSpec spec = fake_mouse();
    spec.sensors.pop_back();
    std::erase_if(spec.ports, [](const PortSpec& port) { return port.name == "buttons"; });
    FakeRun run(spec);
    CHECK(error_of(run.system, Press{"mouse", "button"}) == "mouse has no buttons");
}

TEST_CASE("a hold belongs to its actor until another actor takes it", "[engine][act]") {
    Driving it;
    REQUIRE(it.system.holder("mouse.velocity_in") != nullptr);
    CHECK(*it.system.holder("mouse.velocity_in") == console);
    const std::string refused =
        "mouse.velocity_in is held by another user (console): hold(port, value, { take = true }) takes it";
    CHECK(error_of(it.system, Driving::hold(0.2), tablet) == refused);
    CHECK(error_of(it.system, Release{"mouse.velocity_in"}, tablet) == refused);
    CHECK(error_of(it.system, Drop{"mouse.velocity_in"}, tablet) == refused);
    CHECK(error_of(it.system, Driving::hold(0.05), console).empty());  // its own it may change

    CHECK(error_of(it.system, Driving::hold(0.2, true), tablet).empty());
    CHECK(it.log.back() == ": mouse.velocity_in: its value is held by browser tablet now, no longer by console");
    CHECK(it.system.held_by(tablet) == std::vector<std::string>{"mouse.velocity_in"});
    CHECK(it.system.held_by(console).empty());
    CHECK(error_of(it.system, Release{"mouse.velocity_in"}, tablet).empty());
    CHECK(it.system.holder("mouse.velocity_in") == nullptr);
    CHECK(error_of(it.system, Driving::hold(0.1), console).empty());  // no actor holds it: no need to take it
}

TEST_CASE("actors have names that can be read back", "[engine][act]") {
    for (const Actor& who : {console, tablet, Actor{Actor::Kind::file_watcher}, Actor{Actor::Kind::run}})
        CHECK(actor_from(to_text(who)) == who);
    CHECK(to_text(tablet) == "browser tablet");
    CHECK_FALSE(actor_from("consoles"));
}

TEST_CASE("an emergency stop brakes as hard as it can, then takes the motors' power", "[engine][act][safety]") {
    Driving it;
    REQUIRE(it.speed() == Approx(0.1));
    REQUIRE(error_of(it.system, Stop{}).empty());
    it.move();
    CHECK(it.speed() == Approx(0.08));  // 2 m/s2
    it.move(15);
    CHECK(it.speed() == 0);
    CHECK(it.hull().powered);  // until it has stopped rocking
    CHECK_FALSE(it.hull().coasting);
    it.move(25);
    CHECK_FALSE(it.hull().powered);
    CHECK(it.hull().coasting);
    CHECK(it.note() == "emergency stop: commands are ignored until rearm()");
    CHECK(it.robot->state() == LifeState::active);
    it.move(100);  // the hold goes on, and is ignored
    CHECK_FALSE(it.hull().powered);
    CHECK(it.robot->guard().current() == Velocity2D{});
}

TEST_CASE("rearm needs standstill, and a robot obeys only messages that come after it", "[engine][act][safety]") {
    Driving it;
    CHECK(error_of(it.system, Rearm{}) == "there is no emergency stop: rearm() works only after stop()");
    REQUIRE(error_of(it.system, Stop{}).empty());
    it.move();
    CHECK(error_of(it.system, Rearm{}) == "mouse still moves, at 0.100 m/s and 0.000 rad/s: rearm() needs standstill");
    REQUIRE(error_of(it.system, Release{"mouse.velocity_in"}).empty());
    it.move(10);
    REQUIRE(error_of(it.system, Inject{"mouse.velocity_in", Velocity2D{.vx = 0.3}}).empty());
    REQUIRE(error_of(it.system, Rearm{}).empty());
    CHECK(it.hull().powered);
    CHECK(it.note().empty());
    it.move(10);
    CHECK(it.speed() == 0);  // what came before it, and had not arrived, counts for nothing
    REQUIRE(error_of(it.system, Inject{"mouse.velocity_in", Velocity2D{.vx = 0.3}}).empty());
    it.move(10);
    CHECK(it.speed() == Approx(0.2));
}

TEST_CASE("a servo stays where it is while its robot is stopped", "[engine][act][safety]") {
    FakeRun run;
    run.send("neck_in", 0.5);
    run.ticks(200);
    REQUIRE(run.hull().servos.begin()->second == Approx(0.5));
    REQUIRE(error_of(run.system, Stop{}).empty());
    run.send("neck_in", -0.5);
    run.ticks(50);
    CHECK(run.hull().servos.begin()->second == Approx(0.5));
    REQUIRE(error_of(run.system, Rearm{}).empty());
    run.ticks(50);
    CHECK(run.hull().servos.begin()->second == Approx(0.5));
    run.send("neck_in", -0.5);
    run.ticks(200);
    CHECK(run.hull().servos.begin()->second == Approx(-0.5));
}

TEST_CASE("an emergency stop ends all sound until it is rearmed", "[engine][act][safety]") {
    RobotSpec spec = fake_mouse();
    spec.actuators.push_back({.name = "speaker", .kind = ActuatorSpec::Kind::speaker});
    PortSpec sound;
    sound.name = "sound";
    sound.type = "TimedString";
    sound.items = {"speaker"};
    sound.is_input = true;
    spec.ports.push_back(sound);
    FakeRun run(spec);
    run.send("buzzer_in", std::int16_t{440});
    run.send("sound", std::string("hello"));
    REQUIRE(run.hull().hertz == 440);
    REQUIRE(run.hull().sounds.size() == 1);
    const int silences = run.hull().silences;
    REQUIRE(error_of(run.system, Stop{}).empty());
    CHECK(run.hull().hertz == 0);
    CHECK(run.hull().silences == silences + 1);
    run.send("buzzer_in", std::int16_t{550});
    run.send("sound", std::string("still here"));
    CHECK(run.hull().hertz == 0);
    CHECK(run.hull().sounds.size() == 1);
    run.robot->find_in_port("sound")->inject(std::string("too early"));
    REQUIRE(error_of(run.system, Rearm{}).empty());
    run.ticks(1);
    CHECK(run.hull().sounds.size() == 1);
    run.send("buzzer_in", std::int16_t{660});
    run.send("sound", std::string("here again"));
    CHECK(run.hull().hertz == 660);
    CHECK(run.hull().sounds.size() == 2);
}

TEST_CASE("a robot that is deactivated ends its speech", "[engine][robot]") {
    FakeRun run;
    run.ticks(1);
    const int silences = run.hull().silences;
    REQUIRE(run.robot->deactivate(run.system.now()));
    run.ticks(3);
    CHECK(run.hull().silences == silences + 1);
}

TEST_CASE("a replay can announce the call that times out, and the timeout is reported", "[engine][component]") {
    System system({}, {});
    auto made = std::make_unique<TryComponent>();
    TryComponent& it = *made;
    REQUIRE(system.add(std::move(made)));
    it.run_out_of_time_at({3, Error{"too slow", {}, Error::Kind::out_of_time}});
    REQUIRE(it.activate(system.now()));  // the first call
    system.tick();
    CHECK(it.state() == LifeState::active);
    CHECK_FALSE(it.has_new_out_of_time());
    system.tick();
    CHECK(it.state() == LifeState::error);
    CHECK(it.last_error().message == "too slow");
    const auto told = it.take_out_of_time();
    REQUIRE(told.size() == 1);
    CHECK(told.front().call == 3);
    CHECK_FALSE(it.has_new_out_of_time());
}
