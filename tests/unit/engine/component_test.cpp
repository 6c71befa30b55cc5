// The life of a component: which hook runs when, and what its ports say on the way.
#include "engine/components/component.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/engine/port_pair.hpp"
#include "tests/unit/engine/try_component.hpp"

using namespace nezumi;

namespace {

using Names = std::vector<std::string>;

Expected<void> fail(TryComponent&) { return failure("went wrong", {"a.lua", 3}); }

Expected<void> write_all(TryComponent& it) {
    it.out.write(1);
    it.speed.write({.vx = 0.3});
    it.tone.write(440);
    return {};
}

// What the ports publish in this tick: "out speed=0.3 tone=5".
std::string published(TryComponent& it, std::int64_t tick) {
    it.latch_outputs(at(tick));
    std::string text;
    for (const auto& port : it.out_ports()) {
        if (port->latched_tick() != tick) continue;
        text += (text.empty() ? "" : " ") + port->name();
        if (port->name() == "speed") text += it.speed.read() == Velocity2D{} ? "=0" : "=moving";
        if (port->name() == "tone") text += "=" + std::to_string(it.tone.read());
    }
    return text;
}

}  // namespace

TEST_CASE("states and hooks have OpenRTM's names", "[engine][component]") {
    CHECK(to_text(LifeState::inactive) == "INACTIVE");
    CHECK(to_text(LifeState::active) == "ACTIVE");
    CHECK(to_text(LifeState::error) == "ERROR");
    CHECK(to_text(Hook::on_activated) == "on_activated");
    CHECK(to_text(Hook::on_reload) == "on_reload");
    CHECK(to_text(Hook::none).empty());
}

TEST_CASE("a component is INACTIVE until it is activated, and executes only when ACTIVE", "[engine][component]") {
    TryComponent it;
    CHECK(it.state() == LifeState::inactive);
    it.execute(at(0));
    CHECK(it.hooks.empty());
    REQUIRE(it.activate(at(1)));
    CHECK(it.state() == LifeState::active);
    it.execute(at(1));
    it.execute(at(2));
    CHECK(it.executions() == 2);
    REQUIRE(it.deactivate(at(3)));
    CHECK(it.state() == LifeState::inactive);
    it.execute(at(3));
    CHECK(it.hooks == Names{"on_activated", "on_execute", "on_execute", "on_deactivated"});
    CHECK(it.hook() == Hook::none);
}

TEST_CASE("activating an ACTIVE and deactivating an INACTIVE component changes nothing", "[engine][component]") {
    TryComponent it;
    REQUIRE(it.deactivate(at(0)));
    REQUIRE(it.activate(at(0)));
    REQUIRE(it.activate(at(0)));
    CHECK(it.hooks == Names{"on_activated"});
}

TEST_CASE("an execution that fails sends a component to ERROR, and a reset to INACTIVE", "[engine][component]") {
    TryComponent it;
    it.executed = fail;
    REQUIRE(it.activate(at(0)));
    it.execute(at(0));
    CHECK(it.state() == LifeState::error);
    CHECK(it.last_error() == Error{"went wrong", {"a.lua", 3}});
    CHECK(it.log_lines == Names{"error: a.lua:3: went wrong"});
    it.execute(at(1));
    it.execute(at(2));
    CHECK(it.hooks == Names{"on_activated", "on_execute", "on_aborting", "on_error", "on_error"});
    CHECK(it.activate(at(2)).error().message == "it is in ERROR: reset it first");
    CHECK(it.deactivate(at(2)).error().message == "it is in ERROR: reset it first");
    REQUIRE(it.reset(at(3)));
    CHECK(it.state() == LifeState::inactive);
    CHECK(it.hooks.back() == "on_reset");
    CHECK(it.reset(at(3)).error().message == "it is INACTIVE: only a component in ERROR can be reset");
    REQUIRE(it.activate(at(4)));
    CHECK(it.reset(at(3)).error().message == "it is ACTIVE: only a component in ERROR can be reset");
}

TEST_CASE("hooks that fail on the way: activation and deactivation end in ERROR, a reset stays there",
          "[engine][component]") {
    TryComponent it;
    it.activated = fail;
    CHECK(it.activate(at(0)).error().message == "it went to ERROR: a.lua:3: went wrong");
    CHECK(it.state() == LifeState::error);
    it.reset_hook = fail;
    CHECK(it.reset(at(0)).error().message == "it stays in ERROR: a.lua:3: went wrong");
    CHECK(it.state() == LifeState::error);
    it.activated = it.reset_hook = nullptr;
    REQUIRE(it.reset(at(0)));
    REQUIRE(it.activate(at(0)));
    it.deactivated = fail;
    CHECK(it.deactivate(at(1)).error().message == "it went to ERROR: a.lua:3: went wrong");
    CHECK(it.state() == LifeState::error);
}

TEST_CASE("an on_error that fails is reported once and not called again before a reset", "[engine][component]") {
    TryComponent it;
    it.executed = fail;
    it.error = [](TryComponent&) -> Expected<void> { return failure("went wrong too", {"a.lua", 4}); };
    REQUIRE(it.activate(at(0)));
    for (int tick = 0; tick < 5; ++tick) it.execute(at(tick));
    CHECK(it.last_error() == Error{"went wrong", {"a.lua", 3}});  // why it is in ERROR
    CHECK(it.hooks == Names{"on_activated", "on_execute", "on_aborting", "on_error"});
    CHECK(it.log_lines.back() ==
          "error: on_error failed and is not called again before a reset: a.lua:4: went wrong too");
    REQUIRE(it.reset(at(6)));
    REQUIRE(it.activate(at(6)));
    it.execute(at(7));
    it.execute(at(8));
    CHECK(it.hooks.back() == "on_error");
}

TEST_CASE("leaving ACTIVE by deactivation writes zero velocities and safe values once, the others fall silent",
          "[engine][component][safety]") {
    TryComponent it;
    it.tone.set_safe(std::int16_t{5});
    it.executed = write_all;
    REQUIRE(it.activate(at(0)));
    it.execute(at(0));
    CHECK(published(it, 0) == "out speed=moving tone=440");
    REQUIRE(it.deactivate(at(1)));
    CHECK(published(it, 1) == "speed=0 tone=5");
    CHECK(published(it, 2).empty());
}

TEST_CASE("a value that on_deactivated wrote replaces the safe value", "[engine][component][safety]") {
    TryComponent it;
    it.tone.set_safe(std::int16_t{5});
    it.deactivated = [](TryComponent& self) -> Expected<void> {
        self.speed.write({.vx = 0.05});
        return {};
    };
    REQUIRE(it.activate(at(0)));
    REQUIRE(it.deactivate(at(1)));
    CHECK(published(it, 1) == "speed=moving tone=5");
    // One that fails says nothing.
    REQUIRE(it.activate(at(2)));
    it.deactivated = [](TryComponent& self) -> Expected<void> {
        self.speed.write({.vx = 0.05});
        self.out.write(1);
        return failure("half way");
    };
    CHECK_FALSE(it.deactivate(at(3)));
    CHECK(published(it, 3) == "speed=0 tone=5");
}

TEST_CASE("an execution that fails publishes the safe values, and none that it wrote", "[engine][component][safety]") {
    TryComponent it;
    it.tone.set_safe(std::int16_t{5});
    REQUIRE(it.activate(at(0)));
    it.executed = [](TryComponent& self) {
        static_cast<void>(write_all(self));
        return fail(self);
    };
    it.execute(at(1));
    CHECK(published(it, 1) == "speed=0 tone=5");
    CHECK(published(it, 2).empty());
}

TEST_CASE("neither on_aborting nor on_error can make a robot move", "[engine][component][safety]") {
    TryComponent it;
    it.tone.set_safe(std::int16_t{5});
    it.executed = fail;
    it.aborting = write_all;
    it.error = write_all;
    REQUIRE(it.activate(at(0)));
    it.execute(at(0));
    // The safe value has the last word, also on other ports.
    CHECK(published(it, 0) == "out speed=0 tone=5");
    it.execute(at(1));
    CHECK(published(it, 1) == "out tone=440");
}

TEST_CASE("activation and reset empty the in-ports", "[engine][component]") {
    TryComponent it;
    for (InPortBase* port : {static_cast<InPortBase*>(&it.in), static_cast<InPortBase*>(&it.queue)}) {
        port->inject(std::int32_t{1});
        port->latch(at(0));
        CHECK(port->is_new());
    }
    REQUIRE(it.activate(at(1)));
    CHECK_FALSE(it.in.is_new());
    CHECK_FALSE(it.queue.is_new());
    CHECK(it.in.read() == 0);
    it.executed = fail;
    it.execute(at(2));
    it.in.inject(std::int32_t{1});
    it.in.latch(at(2));
    REQUIRE(it.reset(at(3)));
    CHECK_FALSE(it.in.is_new());
}

TEST_CASE("a queue that overflows is reported once", "[engine][component][port]") {
    TryComponent it;
    for (int tick = 0; tick < 3; ++tick) {
        for (std::int32_t i = 0; i < 4; ++i) it.queue.inject(i);
        it.latch_inputs(at(tick));
    }
    CHECK(it.queue.dropped() == 10);
    CHECK(it.log_lines ==
          Names{"warn: input 'queue': its queue of 2 is full, the oldest message was dropped (reported once)"});
}

TEST_CASE("a queue that overflows is reported even if messages were dropped before because it became shorter",
          "[engine][component][port]") {
    TryComponent it;
    for (std::int32_t i = 0; i < 2; ++i) it.queue.inject(i);
    it.latch_inputs(at(0));
    CHECK(it.queue.set_queue(1).size() == 1);
    CHECK(it.log_lines.empty());
    for (int tick = 1; tick < 4; ++tick) {
        it.queue.inject(std::int32_t{7});
        it.latch_inputs(at(tick));
    }
    CHECK(it.queue.dropped() == 4);
    CHECK(it.log_lines ==
          Names{"warn: input 'queue': its queue of 1 is full, the oldest message was dropped (reported once)"});
}

TEST_CASE("dt is the time since the execution before, and a period at the first", "[engine][component]") {
    TryComponent it;
    it.set_tick_rate(200);
    REQUIRE(it.activate({0, 0}));
    it.execute({0, 0});
    CHECK(it.dt() == Approx(0.005));
    it.execute({7, 0.035});
    CHECK(it.dt() == Approx(0.035));
    CHECK(it.now().tick == 7);
    it.rate = 10;
    REQUIRE(it.deactivate({8, 0.04}));
    REQUIRE(it.activate({100, 0.5}));
    it.execute({100, 0.5});
    CHECK(it.dt() == Approx(0.1));
}

TEST_CASE("ports are found by their names and directions", "[engine][component]") {
    TryComponent it;
    CHECK(it.find_in_port("in") == &it.in);
    CHECK(it.find_in_port("out") == nullptr);
    CHECK(it.find_out_port("out") == &it.out);
    CHECK(it.find_out_port("in") == nullptr);
    CHECK(it.find_port("in") == &it.in);
    CHECK(it.find_port("out") == &it.out);
    CHECK(it.find_port("other") == nullptr);
}

TEST_CASE("a component whose on_deactivated fails between two ticks publishes standstill, whatever on_error does",
          "[engine][component]") {
    TryComponent it;
    it.deactivated = fail;
    it.error = [](TryComponent& self) -> Expected<void> {
        self.speed.write({.vx = 0.3});
        return {};
    };
    REQUIRE(it.activate(at(0)));
    CHECK_FALSE(it.deactivate(at(1)));
    it.execute(at(1));  // on_error, before anything was published
    CHECK(it.hooks.back() == "on_error");
    CHECK(published(it, 1) == "speed=0");
    it.execute(at(2));
    CHECK(published(it, 2).empty());
}
