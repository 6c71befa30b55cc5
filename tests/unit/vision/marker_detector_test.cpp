// The detector as a component: when it publishes.
#include "tests/unit/vision/seen.hpp"

#include <string>
#include <tuple>
#include <utility>

#include "engine/vision/marker_detector.hpp"

using namespace nezumi;

namespace {

struct MarkerWatch : Watched<MarkerDetector> {
    using Watched::Watched;
    Pose3D pos() { return value<Pose3D>("pos"); }
    std::vector<SeenMarker> markers() { return value<std::vector<SeenMarker>>("markers"); }
};

}  // namespace

TEST_CASE("the markers in a picture are published after the camera's and the detector's latency",
          "[vision][detector]") {
    MarkerWatch watch(one_marker(), {{"latency", 0.03}}, {{"latency", 0.05}});
    watch.run(8);  // ticks 0 to 7: exposed in tick 0, published in tick 5, processed from then on
    CHECK(watch.port("pos").count() == 0);
    CHECK(watch.port("visible").count() == 0);
    watch.run(1);
    CHECK(watch.port("pos").count() == 1);
    for (const char* port : {"pos", "visible", "id", "markers"}) CHECK(watch.port(port).tm() == 0);  // the picture's
    CHECK(watch.visible());
    CHECK(watch.port("id").value().get<std::int32_t>() == 7);
    CHECK(watch.pos().position.x == Approx(1).margin(0.005));
}

TEST_CASE("a picture and its intrinsics are stamped with the time of its exposure", "[vision][camera]") {
    MarkerWatch watch(one_marker(), {}, {{"latency", 0.05}, {"frame_rate", 10.0}});
    watch.run(10);  // a tick before the second exposure
    const Component& eye = *watch.system.find("eye");
    CHECK(eye.find_out_port("out")->count() == 1);
    CHECK(eye.find_out_port("out")->tm() == 0);
    watch.run(8);
    CHECK(eye.find_out_port("out")->count() == 2);
    CHECK(eye.find_out_port("out")->tm() == Approx(0.1));
    CHECK(eye.find_out_port("intrinsics")->tm() == Approx(0.1));
}

TEST_CASE("a picture is not copied on its way to a detector", "[vision][camera][detector]") {
    MarkerWatch watch(one_marker());
    const auto& out = dynamic_cast<const OutPort<CameraImage>&>(*watch.system.find("eye")->find_out_port("out"));
    const auto& in = dynamic_cast<const InPort<CameraImage>&>(*watch.detector().find_in_port("image"));
    for (std::uint64_t pictures = 1; pictures < 4; ++pictures) {
        while (out.count() < pictures) watch.run(1);
        REQUIRE(out.read().pixels.size() == std::size_t{640} * 480 * 3);
        CHECK(in.latest().data.pixels.data() == out.read().pixels.data());
    }
}

TEST_CASE("without latency everything comes in the tick of the picture", "[vision][detector]") {
    MarkerWatch watch(one_marker(), {{"latency", 0.0}}, {{"latency", 0.0}});
    watch.run(1);
    CHECK(watch.port("pos").count() == 1);
}

TEST_CASE("thirty pictures per second make thirty positions per second", "[vision][detector]") {
    MarkerWatch watch(one_marker());
    watch.run(205);
    CHECK(std::abs(static_cast<int>(watch.port("pos").count()) - 60) <= 1);
}

TEST_CASE("a detector that is slower than the camera skips pictures", "[vision][detector]") {
    MarkerWatch watch(one_marker(), {{"latency", 0.1}});
    watch.run(205);
    CHECK(watch.port("visible").count() >= 18);
    CHECK(watch.port("visible").count() <= 20);
}

TEST_CASE("when the marker disappears, positions stop and visible becomes false", "[vision][detector]") {
    MarkerWatch watch(one_marker());
    watch.run(50);
    CHECK(watch.visible());
    REQUIRE(watch.system.world()->move_marker("target", {{0, 0, -10}, {}}));
    watch.run(8);
    const auto count = watch.port("pos").count();
    const auto looks = watch.port("visible").count();
    watch.run(50);
    CHECK_FALSE(watch.visible());
    CHECK(watch.port("pos").count() == count);
    CHECK(watch.port("visible").count() > looks);
}

TEST_CASE("the intrinsics of a picture are used, otherwise those of the detector", "[vision][detector]") {
    MarkerWatch wide(one_marker({0.6, 0, 0.1}), {}, {{"field_of_view", 1.6}, {"width", std::int64_t{800}}});
    wide.run(20);
    CHECK(wide.pos().position.x == Approx(0.6).margin(0.01));
    const auto told = wide.detector().find_in_port("intrinsics")->value().get<CameraIntrinsics>();
    CHECK(told.width == 800);
    CHECK(told == pinhole(800, 480, 1.6));

    MarkerWatch given(one_marker({0.6, 0, 0.1}), {{"fx", 2 * pinhole(640, 480, field_of_view).fx}});
    given.run(20);
    CHECK(given.pos().position.x == Approx(1.2).margin(0.02));

    const auto world = world_with(one_marker({0.6, 0, 0.1}));
    MarkerWatch apart(one_marker({0.6, 0, 0.1}), {{"field_of_view", 1.6}}, {}, false);
    apart.show(picture_of(*world, {.field_of_view = 1.6}));
    apart.run(5);
    CHECK(apart.pos().position.x == Approx(0.6).margin(0.01));
}

TEST_CASE("each of the detector's intrinsics is used, and those that are 0 follow fx and the middle",
          "[vision][detector]") {
    const CameraIntrinsics c = pinhole(640, 480, field_of_view);
    const auto seen = [&](ParameterValues values) {
        values.emplace("fx", c.fx);
        MarkerWatch watch(one_marker({0.6, 0.1, 0.15}), values);
        watch.run(20);
        REQUIRE(watch.visible());
        return watch.pos().position;
    };
    const Point3D plain = seen({});
    CHECK(plain.x == Approx(0.6).margin(0.005));
    CHECK(plain.y == Approx(0.1).margin(0.002));
    CHECK(plain.z == Approx(0.05).margin(0.002));
    CHECK(seen({{"fy", c.fx}, {"cx", c.cx}, {"cy", c.cy}}) == plain);
    // If the middle is 20 pixels farther right or down, the marker is farther left or up by the same angle.
    CHECK(seen({{"cx", c.cx + 20}}).y - plain.y == Approx(20 / c.fx * 0.6).epsilon(0.1));
    CHECK(seen({{"cy", c.cy + 20}}).z - plain.z == Approx(20 / c.fx * 0.6).epsilon(0.1));
    CHECK(seen({{"fy", 1.2 * c.fx}}).z < 0.95 * plain.z);
}

TEST_CASE("a detector's parameters are taken within their bounds and refused beyond", "[vision][detector]") {
    MarkerWatch watch(one_marker());
    for (const auto& [name, low, high] : {std::tuple{"tag_size", 0.001, 100.0},
                                          {"latency", 0.0, 10.0},
                                          {"yaw_from", 0.0, 10000.0},
                                          {"fx", 0.0, 1e6},
                                          {"fy", 0.0, 1e6},
                                          {"cx", 0.0, 1e6},
                                          {"cy", 0.0, 1e6},
                                          {"field_of_view", 0.05, 2.8}}) {
        check_bounds(watch.detector(), name, low, high);
    }
    Parameters& parameters = watch.detector().parameters();
    CHECK(parameters.set("id", std::int64_t{-1}));
    CHECK(parameters.set("id", std::int64_t{586}));
    CHECK_FALSE(parameters.set("id", std::int64_t{-2}));
    CHECK_FALSE(parameters.set("id", std::int64_t{587}));
    CHECK(parameters.set("family", std::string("16h5")));
    CHECK_FALSE(parameters.set("family", std::string("17h5")));
}

TEST_CASE("intrinsics that change while it runs are those of the pictures from then on", "[vision][detector]") {
    MarkerWatch watch(one_marker({0.6, 0, 0.1}));
    watch.run(20);
    REQUIRE(watch.system.find("eye")->parameters().set("field_of_view", 1.6));
    watch.run(20);
    CHECK(watch.pos().position.x == Approx(0.6).margin(0.01));
    CHECK(watch.said.empty());
}

TEST_CASE("a distorted marker is found at its true place", "[vision][detector]") {
    const Point3D at{0.7, 0.25, 0.22};
    const ParameterValues barrel{{"k1", -0.3}, {"k2", 0.1}, {"p1", 0.005}, {"p2", -0.005}};
    MarkerWatch watch(one_marker(at), {}, barrel);
    watch.run(20);
    REQUIRE(watch.visible());
    CHECK(watch.pos().position.x == Approx(at.x).margin(0.007));
    CHECK(watch.pos().position.y == Approx(at.y).margin(0.003));
    CHECK(watch.pos().position.z == Approx(at.z - 0.1).margin(0.003));
    // With a pinhole's intrinsics, the same picture gives another position.
    MarkerWatch blind(one_marker(at), {{"fx", pinhole(640, 480, field_of_view).fx}}, barrel);
    blind.run(20);
    REQUIRE(blind.visible());
    CHECK(std::abs(blind.pos().position.x - at.x) > 0.01);
}

TEST_CASE("distortion is removed on request, and measured focal lengths are used", "[vision][camera]") {
    const Point3D at{0.7, 0.2, 0.2};
    MarkerWatch watch(one_marker(at), {},
                      {{"k1", -0.3}, {"k2", 0.1}, {"undistort", true}, {"fx", 500.0}, {"fy", 505.0}, {"cx", 330.0}});
    watch.run(20);
    const auto& seen = static_cast<const OutPort<CameraIntrinsics>&>(
        *std::as_const(*watch.system.find("eye")).find_out_port("intrinsics"));
    CHECK(seen.read() == CameraIntrinsics{.width = 640, .height = 480, .fx = 500, .fy = 505, .cx = 330, .cy = 239.5});
    REQUIRE(watch.visible());
    CHECK(watch.pos().position.x == Approx(at.x).margin(0.004));
    CHECK(watch.pos().position.y == Approx(at.y).margin(0.003));
}

TEST_CASE("a picture whose size differs from its intrinsics is reported and not used", "[vision][detector]") {
    MarkerWatch watch(one_marker());
    watch.run(20);
    REQUIRE(watch.system.disconnect("eye.out", "detector.image"));
    watch.show(picture_of(*watch.system.world(), {.width = 320, .height = 240, .field_of_view = field_of_view}));
    watch.run(5);
    CHECK_FALSE(watch.visible());
    CHECK(watch.said == std::vector<std::string>{
                            "image: 320 x 240 pixels, but intrinsics for 640 x 480: the picture is not searched"});
}

TEST_CASE("a camera whose distortion folds its image goes to ERROR", "[vision][detector]") {
    MarkerWatch watch(one_marker());
    REQUIRE(watch.system.find("eye")->parameters().set("k1", -1.5));
    watch.run(2);
    CHECK(watch.system.find("eye")->state() == LifeState::error);
    REQUIRE(watch.said.size() == 1);
    CHECK(watch.said[0].find("a distortion of k1 = -1.5, k2 = 0, p1 = 0, p2 = 0, k3 = 0 folds the picture over") !=
          std::string::npos);
}

TEST_CASE("a small marker has no orientation", "[vision][detector]") {
    MarkerWatch far_off(one_marker({2.5, 0, 0.1}, M_PI + 0.5));
    far_off.run(20);
    REQUIRE(far_off.visible());
    CHECK(far_off.pos().orientation == Orientation3D{});
    MarkerWatch near_by(one_marker({0.6, 0, 0.1}, M_PI + 0.5));
    near_by.run(20);
    CHECK(near_by.pos().orientation.y == Approx(0.5).margin(0.03));
}

TEST_CASE("only the requested marker is found", "[vision][detector]") {
    MarkerWatch watch(one_marker(), {{"id", std::int64_t{8}}});
    watch.run(20);
    CHECK_FALSE(watch.visible());
    CHECK(watch.port("visible").count() > 0);
    CHECK(watch.port("pos").count() == 0);
}

TEST_CASE("all markers in sight come at once, the nearest first", "[vision][detector]") {
    ArenaSpec arena;
    const Point3D places[] = {{1.2, 0.3, 0.1}, {0.7, -0.2, 0.15}, {0.9, 0, 0.08}};
    for (int i = 0; i < 3; ++i) {
        arena.markers.push_back({.name = "marker" + std::to_string(i), .id = i, .at = places[i], .facing = M_PI});
    }
    MarkerWatch watch(arena);
    watch.run(20);
    const auto seen = watch.markers();
    REQUIRE(seen.size() == 3);
    const int nearest_first[] = {1, 2, 0};
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(seen[i].id == nearest_first[i]);
        const Point3D& at = places[nearest_first[i]];
        CHECK(seen[i].pose.position.x == Approx(at.x).margin(0.01));
        CHECK(seen[i].pose.position.y == Approx(at.y).margin(0.01));
        CHECK(seen[i].pose.position.z == Approx(at.z - 0.1).margin(0.01));
    }
    // pos and id belong to the first of them.
    CHECK(watch.value<std::int32_t>("id") == 1);
    CHECK(watch.pos() == seen[0].pose);

    REQUIRE(watch.detector().parameters().set("id", std::int64_t{2}));
    watch.run(20);
    REQUIRE(watch.markers().size() == 1);
    CHECK(watch.markers()[0].id == 2);
}

TEST_CASE("two markers with the same number are both found", "[vision][detector]") {
    ArenaSpec arena = one_marker({1, 0.2, 0.1});
    arena.markers.push_back({.name = "its twin", .id = 7, .at = {0.9, -0.2, 0.1}, .facing = M_PI});
    MarkerWatch watch(arena, {{"id", std::int64_t{7}}});
    watch.run(20);
    REQUIRE(watch.markers().size() == 2);
    CHECK(watch.markers()[0].pose.position.y == Approx(-0.2).margin(0.01));
    CHECK(watch.markers()[1].pose.position.y == Approx(0.2).margin(0.01));
}

TEST_CASE("without a marker an empty list is published once per picture", "[vision][detector]") {
    MarkerWatch watch(one_marker());
    watch.run(50);
    CHECK(watch.markers().size() == 1);
    REQUIRE(watch.system.world()->move_marker("target", {{0, 0, -10}, {}}));
    watch.run(20);
    CHECK(watch.markers().empty());
    CHECK(watch.port("markers").count() == watch.port("visible").count());
    CHECK(watch.port("markers").count() > watch.port("pos").count());
}

TEST_CASE("a broken picture is reported once and not used", "[vision][detector]") {
    MarkerWatch watch(one_marker(), {}, {}, false);
    const CameraImage good = picture_of(*watch.system.world());
    CameraImage torn = good;
    torn.pixels.resize(1000);
    for (const CameraImage& bad : {torn, CameraImage{}, torn}) {
        watch.show(bad);
        watch.run(5);
        CHECK_FALSE(watch.visible());
    }
    CHECK(watch.port("pos").count() == 0);
    CHECK(watch.said ==
          std::vector<std::string>{
              "image: 640 x 480 pixels of rgb8 need 921600 bytes, got 1000: the picture is not searched"});
    watch.show(good);
    watch.run(5);
    CHECK(watch.visible());
    watch.show(CameraImage{});
    watch.run(5);
    CHECK(watch.said.size() == 2);
    CHECK(watch.detector().state() == LifeState::active);
}

TEST_CASE("the same run has the same trace, also with noise", "[vision][detector]") {
    const auto trace = [](double noise) {
        MarkerWatch watch(one_marker(), {}, {{"noise", noise}});
        watch.run(60);
        return watch.hash.value();
    };
    CHECK(trace(3) == trace(3));
    CHECK(trace(3) != trace(4));
}

TEST_CASE("a stopped detector drops its present picture", "[vision][detector]") {
    MarkerWatch watch(one_marker());
    watch.run(3);  // the first picture has just arrived
    REQUIRE(watch.detector().deactivate(watch.system.now()));
    watch.run(20);
    CHECK(watch.port("visible").count() == 0);
    REQUIRE(watch.detector().activate(watch.system.now()));
    watch.run(20);
    CHECK(watch.visible());
}

TEST_CASE("a detector is not mounted on a robot", "[vision][detector]") {
    System system({.rate = 100}, {});
    const auto made =
        make_image_component<MarkerDetector>({.name = "detector", .type = "MarkerDetector", .on = "mouse"}, system);
    REQUIRE_FALSE(made);
    CHECK(made.error().message ==
          "component 'detector': a MarkerDetector is not mounted on a robot: 'on' is for its Camera");
}
