// The joystick: where the stick is, and the wheels' speeds that it stands for.
#include <catch2/catch.hpp>

#include <cmath>

#include "engine/devices/joystick.hpp"
#include "engine/system/system.hpp"

using namespace nezumi;

namespace {

using Floats = std::vector<float>;

struct Stick {
    explicit Stick(double rate = 0) : system({}, {}) {
        auto made = std::make_unique<Joystick>("stick");
        stick = made.get();
        stick->rate = rate;
        REQUIRE(system.add(std::move(made)));
        REQUIRE(stick->activate(system.now()));
    }
    OutPort<Floats>& port(const char* name) { return static_cast<OutPort<Floats>&>(*stick->find_out_port(name)); }
    // Two ticks: what arrives in one is published in the next.
    void hold(Floats place) {
        stick->find_in_port("stick")->hold(std::move(place));
        system.tick();
        system.tick();
    }

    System system;
    Joystick* stick = nullptr;
};

}  // namespace

TEST_CASE("a joystick publishes at its rate whether or not the stick moved", "[engine][joystick]") {
    for (const auto& [rate, expected] : {std::pair{0.0, 100u}, {10.0, 10u}, {25.0, 25u}}) {
        Stick it(rate);
        for (int i = 0; i < 100; ++i) it.system.tick();
        CHECK(it.port("pos").count() == expected);
        CHECK(it.port("vel").count() == expected);
        CHECK(it.port("pos").read() == Floats{0, 0});
        CHECK(it.port("vel").read() == Floats{0, 0});
    }
}

TEST_CASE("the wheel speeds are the stick position rotated by 45 degrees", "[engine][joystick]") {
    Stick it;
    const float diagonal = 150 * std::sqrt(0.5F);
    it.hold({0, 150});
    CHECK(it.port("pos").read() == Floats{0, 150});
    CHECK(it.port("vel").read()[0] == Approx(diagonal));
    CHECK(it.port("vel").read()[1] == Approx(diagonal));
    it.hold({150, 0});  // to the right: the left wheel forward
    CHECK(it.port("vel").read()[0] == Approx(diagonal));
    CHECK(it.port("vel").read()[1] == Approx(-diagonal));
    it.hold({-100, 100});
    CHECK(it.port("vel").read()[0] == Approx(0).margin(1e-4));
    CHECK(it.port("vel").read()[1] == Approx(std::hypot(100, 100)));
    it.stick->find_in_port("stick")->release();
    it.system.tick();
    it.system.tick();
    CHECK(it.port("pos").read() == Floats{0, 0});
    CHECK(it.port("vel").read() == Floats{0, 0});
}

TEST_CASE("an invalid position of the stick is its centre, and one outside of the pad is its edge",
          "[engine][joystick]") {
    Stick it;
    for (const Floats& odd : {Floats{}, Floats{100}, Floats{std::nanf(""), 1}}) {
        it.hold(odd);
        CHECK(it.port("pos").read() == Floats{0, 0});
        CHECK(it.port("vel").read() == Floats{0, 0});
    }
    it.hold({-1000, 151, 7});
    CHECK(it.port("pos").read() == Floats{-150, 150});
}

TEST_CASE("a stick that is sent somewhere once is there once, however slow the joystick", "[engine][joystick]") {
    for (const double rate : {0.0, 10.0}) {
        Stick it(rate);
        it.system.tick();
        it.stick->find_in_port("stick")->inject(Floats{0, 100});
        int there = 0;
        for (int i = 0; i < 100; ++i) {
            const auto before = it.port("pos").count();
            it.system.tick();
            if (it.port("pos").count() > before && it.port("pos").read() == Floats{0, 100}) ++there;
        }
        CHECK(there == 1);
    }
}

TEST_CASE("a joystick that is not active is silent", "[engine][joystick]") {
    Stick it;
    REQUIRE(it.stick->deactivate(it.system.now()));
    it.system.tick();
    CHECK(it.port("pos").count() == 0);
}

namespace {

// A gamepad that says what a test wants.
struct Told : Gamepad {
    explicit Told(std::optional<GamepadState>& its_state) : told(its_state) {}
    std::optional<GamepadState> state() override { return told; }
    std::vector<std::string> take_faults() override { return {}; }
    std::optional<GamepadState>& told;
};

}  // namespace

TEST_CASE("a joystick with a gamepad asks for it anew when its parameters change", "[engine][joystick]") {
    std::vector<GamepadSettings> opened;
    std::optional<GamepadState> told = GamepadState{.x = 0.5, .y = -1, .axes = {0.5F, 1}, .buttons = {true}};
    System system({}, {});
    auto made = std::make_unique<Joystick>("stick", [&](const GamepadSettings& settings) {
        opened.push_back(settings);
        return std::make_unique<Told>(told);
    });
    Joystick& stick = *made;
    REQUIRE(system.add(std::move(made)));
    REQUIRE(stick.activate(system.now()));
    system.tick();
    const auto& pos = static_cast<const OutPort<Floats>&>(*stick.find_out_port("pos"));
    CHECK(pos.read() == Floats{75, -150});
    CHECK(static_cast<const OutPort<Floats>&>(*stick.find_out_port("axes")).read() == Floats{0.5F, 1});
    told->stops = 1;
    system.tick();
    CHECK(stick.stops() == 1);
    REQUIRE(stick.parameters().set("device", std::string("/dev/input/event4")));
    told->stops = 0;
    system.tick();
    REQUIRE(opened.size() == 2);
    CHECK(opened[1] == GamepadSettings{.device = "/dev/input/event4", .dead_man_button = "", .stop_button = ""});
    CHECK(stick.stops() == 1);
    told.reset();
    const auto before = pos.count();
    for (int i = 0; i < 10; ++i) system.tick();
    CHECK(pos.count() == before + 1);
    CHECK(pos.read() == Floats{0, 0});
}
