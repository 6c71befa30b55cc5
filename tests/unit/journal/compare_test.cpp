// The values in which two runs differ.
#include <catch2/catch.hpp>

#include "bindings/journal/compare_runs.hpp"
#include "bindings/journal/field_curves.hpp"
#include "engine/ports/messages.hpp"

using namespace nezumi;

TEST_CASE("pictures that differ only in their bytes are reported as different", "[journal][compare]") {
    CameraImage image{.width = 2, .height = 1, .format = "gray8", .pixels = {1, 2}};
    const Value then = image;
    image.pixels[1] = 3;
    const Value now = image;
    CHECK(differing_values("eye.out", &then, &then, 1e-6).empty());
    const auto found = differing_values("eye.out", &then, &now, 1e-6);
    REQUIRE(found.size() == 1);
    CHECK(found[0].name == "eye.out");
    CHECK_FALSE(found[0].by);
    // With another size, that is the difference.
    image.width = 1;
    const Value other = image;
    REQUIRE_FALSE(differing_values("eye.out", &then, &other, 1e-6).empty());
    CHECK(differing_values("eye.out", &then, &other, 1e-6)[0].name == "eye.out.width");
}

TEST_CASE("numbers that differ by no more than the tolerance are equal; a missing value is a difference",
          "[journal][compare]") {
    const Value then = Velocity2D{0.1, 0, 0}, now = Velocity2D{0.1 + 1e-9, 0, 0};
    CHECK(differing_values("keeper.out", &then, &now, 1e-6).empty());
    REQUIRE(differing_values("keeper.out", &then, &now, 0).size() == 1);
    CHECK(differing_values("keeper.out", &then, nullptr, 1).size() == 3);
}

TEST_CASE("curves have the numbers of messages at their times, only of the fields that are asked for",
          "[journal][compare]") {
    FieldCurves all, one({"keeper.out.vx"});
    for (FieldCurves* curves : {&all, &one}) {
        curves->add("keeper.out", Value(Velocity2D{0.1, 0, 0.5}), 0.01);
        curves->add("keeper.out", Value(Velocity2D{0.2, 0, 0.5}), 0.02);
    }
    CHECK(all.names() == std::vector<std::string>{"keeper.out.va", "keeper.out.vx", "keeper.out.vy"});
    CHECK(one.names() == std::vector<std::string>{"keeper.out.vx"});
    CHECK(one.of("keeper.out.vx") == FieldCurves::Points{{0.01, 0.1}, {0.02, 0.2}});
    CHECK(one.of("keeper.out.va").empty());
}
