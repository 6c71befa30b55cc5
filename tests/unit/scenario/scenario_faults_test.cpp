// Faults: how they lie over one another, end, and give way to what was there before.
#include "bindings/scenario/faults.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "tests/unit/scenario/scenario_rig.hpp"

using namespace nezumi;

namespace {

constexpr double for_ever = std::numeric_limits<double>::infinity();

// What a body comes to with `w`, a world, and `is(text)`, which checks the override of the port `p`.
std::string outcome_with_port(const std::string& body) {
    return outcome_of(
        "local w = s:load 'systems/stop_at_wall.lua'\n"
        "local p = 'mouse.ir_sensor_out'\n"
        "local port = w.mouse.ports.ir_sensor_out\n"
        "local function is(what) s:check(port.override == what, 'it is ' .. port.override .. ', not ' .. what) end\n" +
        body);
}

}  // namespace

TEST_CASE("faults end in their time, and what lay under one works again", "[lua][scenario][faults]") {
    std::string done;
    Faults faults;
    const auto effect = [&](char put, char undone) {
        return Faults::Effect{.put = [&done, put] { done += put; }, .undo = [&done, undone] { done += undone; }};
    };
    faults.begin("w mouse press a", 0, 1, effect('A', 'a'));
    faults.begin("w mouse press b", 0, 2, effect('B', 'b'));
    faults.begin("w mouse.port", 0, 5, effect('X', 'x'));
    faults.begin("w mouse.port", 0, 3, effect('P', 'p'));
    faults.begin("w mouser press a", 0, 9, effect('M', 'm'));
    faults.end_due(0.99);
    CHECK(done.empty());
    faults.end_due(1);
    CHECK(done == "a");
    CHECK(faults.restore("w mouse") == 1);
    CHECK(done == "ab");
    faults.end_due(3);
    CHECK(done == "abX");
    faults.end_due(5);
    CHECK(done == "abXx");
    CHECK(faults.restore("w mouser") == 1);
    CHECK(done == "abXxm");
    CHECK(faults.empty());
}

TEST_CASE("a fault that ends under another one says nothing", "[lua][scenario][faults]") {
    std::string done;
    Faults faults;
    const auto effect = [&](char put, char undone) {
        return Faults::Effect{.put = [&done, put] { done += put; }, .undo = [&done, undone] { done += undone; }};
    };
    faults.begin("port", 0, 1, effect('A', 'a'));
    faults.begin("port", 0, 2, effect('B', 'b'));
    faults.end_due(1);
    CHECK(done.empty());
    faults.end_due(2);
    CHECK(done == "b");
    faults.begin("port", 2, 1, effect('C', 'c'));
    faults.begin("port", 2, for_ever, effect('D', 'd'));  // takes its place
    faults.end_due(4);
    CHECK(done == "b");
    faults.begin("port", 4, 1, effect('E', 'e'));
    faults.begin("port", 4, 3, effect('F', 'f'));
    CHECK(faults.restore("port") == 3);
    CHECK(done == "bf");
    CHECK(faults.empty());
}

TEST_CASE("a hold holds again when the fault over it has ended", "[lua][scenario][faults]") {
    for (const std::string fault : {"drop", "freeze"}) {
        CAPTURE(fault);
        const std::string is = fault == "drop" ? "is 'dropped'\n" : "is 'frozen'\n";
        CHECK(outcome_with_port("s:hold(p, { 1, 2, 3, 4 })\n"
                                "s:run(0.1) is 'held'\n"
                                "s:" +
                                fault +
                                "(p, 0.5)\n"
                                "s:run(0.5) " +
                                is +
                                "s:run(0.1) is 'held'\n"
                                "s:check(port.value[1] == 1 and port.value[4] == 4)\n"
                                "s:" +
                                fault +
                                "(p, 0.2) s:run(0.3) is 'held'\n"  // and as often as it likes
                                "s:" +
                                fault +
                                "(p, 0.5) s:run(0.1) s:restore(w.mouse) is 'held'\n"
                                "s:" +
                                fault +
                                "(p, 0.5) s:run(0.1) s:restore(p) is ''\n"
                                "s:run(1) is ''") == "passed");
    }
}

TEST_CASE("what takes the place of a fault stays when its time has come", "[lua][scenario][faults]") {
    CHECK(outcome_with_port("s:hold(p, { 1, 2, 3, 4 }) s:drop(p, 0.5)\n"
                            "s:hold(p, { 5, 6, 7, 8 })\n"
                            "s:run(1) is 'held' s:check(port.value[1] == 5)\n"
                            "s:freeze(p, 0.1) s:run(0.2) is 'held' s:check(port.value[1] == 5)\n"
                            "s:drop(p, 0.5) port:release() s:freeze(p, 0.1) s:run(1) is ''\n"
                            "s:drop(p, 0.2) s:freeze(p) s:run(1) is 'frozen'") == "passed");
}

TEST_CASE("a lasting fault works again when the one over it has ended", "[lua][scenario][faults]") {
    CHECK(outcome_with_port("s:freeze(p) s:run(0.1)\n"
                            "local value = port.value[2]\n"
                            "s:drop(p, 0.2) s:run(0.2) is 'dropped'\n"
                            "s:run(0.1) is 'frozen' s:check(port.value[2] == value)\n"
                            "s:drop(p) s:freeze(p, 0.1) s:run(0.1) is 'frozen' s:run(0.1) is 'dropped'\n"
                            "s:drop(p, 0.3) s:freeze(p, 0.1) s:run(0.2) is 'dropped'\n"
                            "s:run(0.2) is 'dropped' s:restore(p) is ''") == "passed");
}

TEST_CASE("release ends a hold, also that under a fault, and no fault", "[lua][scenario][faults]") {
    CHECK(outcome_with_port("s:hold(p, { 1, 2, 3, 4 }) s:drop(p, 0.5)\n"
                            "s:run(0.1) s:release(p) is 'dropped'\n"
                            "s:run(0.5) is ''\n"
                            "s:release(p)\n"
                            "s:hold(p, { 1, 2, 3, 4 }) s:release(p) is ''") == "passed");
    CHECK(outcome_with_port("s:drop(p) s:release(p)") ==
          "could not run: it_test.lua:6: release: mouse.ir_sensor_out is dropped, not held: s:restore ends that");
    CHECK(outcome_with_port("s:freeze(p, 1) s:release(p)") ==
          "could not run: it_test.lua:6: release: mouse.ir_sensor_out is frozen, not held: s:restore ends that");
}

TEST_CASE("a push that lasts goes on after one that did not", "[lua][scenario][faults]") {
    CHECK(outcome_of("local w = s:load 'systems/stop_at_wall.lua'\n"
                     "w.controller:deactivate()\n"
                     "local m = s.mouse\n"
                     "s:disturb(m, { vx = 0.1 })\n"
                     "s:disturb(m, { va = 1, seconds = 0.3 })\n"
                     "s:run(0.3) s:near(m.truth.velocity.va, 1, 0.01)\n"
                     "s:run(0.2) s:near(m.truth.velocity.vx, 0.1, 0.01)\n"
                     "s:restore(m) s:run(0.5) s:near(m.truth.velocity.vx, 0, 0.01)") == "passed");
}

TEST_CASE("a button that is held down stays so after a press of some time", "[lua][scenario][faults]") {
    const std::string begin =
        "local w = s:load 'systems/stop_at_wall.lua'\n"
        "local function down() return w.mouse.switch3bit_out.value[1] end\n";
    CHECK(outcome_of(begin + "s:press('mouse', 'switch0') s:press('mouse', 'switch0', 0.2)\n"
                             "s:run(0.1) local pressed = down()\n"
                             "s:run(1) s:check(down() == pressed)\n"
                             "s:restore('mouse') s:run(0.1) s:check(down() ~= pressed)") == "passed");
}
