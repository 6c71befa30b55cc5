// Faults: several on one port or robot, their ends, and the return to the state before.
#include "bindings/scenario/faults.hpp"

#include <catch2/catch.hpp>
#include <limits>

using namespace nezumi;

namespace {

constexpr double for_ever = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("faults end at their time, and the effect below works again", "[lua][scenario][faults]") {
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

TEST_CASE("a fault that ends below another one is not reported", "[lua][scenario][faults]") {
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
