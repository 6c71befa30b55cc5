// Positions of tags, compared with the truth of the simulated world.
#include "tests/unit/vision/seen.hpp"

using namespace nezumi;

TEST_CASE("a marker is found where it is: x ahead, y to the left, z up", "[vision][tag]") {
    for (const Point3D at : {Point3D{1, 0, 0.1}, Point3D{1, 0.3, 0.1}, Point3D{0.8, -0.25, 0.2},
                             Point3D{0.4, 0.1, 0.06}, Point3D{1.5, 0.5, 0.4}}) {
        const auto world = world_with(one_marker(at));
        const FoundTag tag = only_tag(*world);
        CHECK(tag.id == 7);
        CHECK(tag.pose.position.x == Approx(at.x).margin(0.005 * at.x));
        CHECK(tag.pose.position.y == Approx(at.y).margin(0.003));
        CHECK(tag.pose.position.z == Approx(at.z - 0.1).margin(0.003));
    }
}

TEST_CASE("the middle of the picture is on the optical axis, to a fifth of a pixel", "[vision][tag]") {
    // AprilTag counts from a pixel's corner: without the half pixel, y and z would be off by 0.9 mm at 1 m.
    const FoundTag tag = only_tag(*world_with(one_marker()));
    CHECK(std::abs(tag.pose.position.y) < 0.0004);
    CHECK(std::abs(tag.pose.position.z) < 0.0004);
}

TEST_CASE("a marker turned to the left has a positive yaw, and a tilted one a pitch", "[vision][tag]") {
    const auto world = world_with(one_marker({0.5, 0, 0.1}));
    for (const double turn : {-0.7, -0.4, 0.4, 0.7}) {
        REQUIRE(world->move_marker("target", {{0.5, 0, 0.1}, {.y = M_PI + turn}}));
        CHECK(only_tag(*world).pose.orientation.y == Approx(turn).margin(0.03));
    }
    for (const double tilt : {-0.5, 0.5}) {
        // Its front is turned down, so in the picture it leans towards the camera.
        REQUIRE(world->move_marker("target", {{0.5, 0, 0.1}, {.p = tilt, .y = M_PI}}));
        CHECK(only_tag(*world).pose.orientation.p == Approx(-tilt).margin(0.03));
    }
    REQUIRE(world->move_marker("target", {{0.5, 0, 0.1}, {.r = 0.5, .y = M_PI}}));
    CHECK(only_tag(*world).pose.orientation.r == Approx(-0.5).margin(0.01));
}

TEST_CASE("a tag's edge has the length that the pinhole model gives", "[vision][tag]") {
    const double fx = pinhole(640, 480, field_of_view).fx;
    CHECK(only_tag(*world_with(one_marker({0.5, 0, 0.1}))).edge == Approx(fx * 0.1 / 0.5).margin(1));
    CHECK(only_tag(*world_with(one_marker({1, 0.3, 0.1}))).edge == Approx(fx * 0.1 / 1).margin(1));
}

TEST_CASE("with a wrong size every distance is wrong by wrong / right", "[vision][tag]") {
    const auto world = world_with(one_marker({1, 0.2, 0.1}));
    const FoundTag right = only_tag(*world, 0.1), wrong = only_tag(*world, 0.2);
    CHECK(wrong.pose.position.x == Approx(2 * right.pose.position.x));
    CHECK(wrong.pose.position.y == Approx(2 * right.pose.position.y));
}

TEST_CASE("of several markers the nearest comes first", "[vision][tag]") {
    ArenaSpec arena = one_marker({1.0, 0.2, 0.1});
    arena.markers.push_back({.name = "near", .id = 300, .size = 0.1, .at = {0.6, -0.1, 0.1}, .facing = M_PI});
    const auto tags = tags_in(picture_of(*world_with(arena)));
    REQUIRE(tags.size() == 2);
    CHECK(tags[0].id == 300);
    CHECK(tags[1].id == 7);
}

TEST_CASE("every tag of the family is found with its own number", "[vision][tag]") {
    for (const int id : {0, 1, 7, 123, 400, 586}) {
        ArenaSpec arena = one_marker({0.5, 0, 0.1});
        arena.markers[0].id = id;
        CHECK(only_tag(*world_with(arena)).id == id);
    }
}

TEST_CASE("a marker is found in spite of noise and blur", "[vision][tag]") {
    const auto world = world_with(one_marker());
    const auto tags = tags_in(picture_of(*world, {.field_of_view = field_of_view, .noise = 8, .blur = 1.0}));
    REQUIRE(tags.size() == 1);
    CHECK(tags[0].pose.position.x == Approx(1).margin(0.03));
}

TEST_CASE("a marker is not found behind a box, from behind, from the side, or far away", "[vision][tag]") {
    ArenaSpec arena = one_marker();
    arena.boxes.push_back({.at = {0.5, 0, 0.15}, .size = {0.1, 0.3, 0.3}});
    CHECK(tags_in(picture_of(*world_with(arena))).empty());
    CHECK(tags_in(picture_of(*world_with(one_marker({1, 0, 0.1}, 0)))).empty());
    CHECK(tags_in(picture_of(*world_with(one_marker({1, 0, 0.1}, M_PI / 2)))).empty());
    CHECK(tags_in(picture_of(*world_with(one_marker({-1, 0, 0.1}, 0)))).empty());
    CHECK(tags_in(picture_of(*world_with(one_marker({20, 0, 0.1})))).empty());
}

TEST_CASE("no tag is found in small pictures and in pure noise", "[vision][tag]") {
    for (const int width : {1, 2, 3, 15, 16, 17, 33}) {
        for (const int height : {1, 2, 3, 16, 19, 40}) {
            GrayImage image{width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(width * height))};
            std::uint32_t random = 1;
            for (std::uint8_t& pixel : image.pixels) {
                random = random * 1664525 + 1013904223;
                pixel = static_cast<std::uint8_t>(random >> 24);
            }
            CHECK(TagFinder("36h11").find(image, pinhole(width, height, 1), 0.1).empty());
        }
    }
}
