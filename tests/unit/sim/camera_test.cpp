// What a simulated camera sees.
#include "tests/unit/sim/try_world.hpp"

#include <array>
#include <filesystem>
#include <fstream>
#include <set>

#include "engine/devices/camera.hpp"
#include "engine/system/system.hpp"
#include "engine/world/camera_source.hpp"
#include "sim/image_noise.hpp"
#include "sim/painter.hpp"
#include "sim/picture.hpp"

using namespace nezumi;
using namespace nezumi::sim;

namespace {

CameraImage shoot(World& world, const CameraMount& mount, CameraSettings settings = {}) {
    if (settings.field_of_view == 0) settings.field_of_view = 1.0;
    auto camera = world.open_camera(mount, settings);
    REQUIRE(camera);
    CameraImage image;
    (*camera)->expose({});
    (*camera)->develop(image);
    return image;
}

std::array<int, 3> pixel(const CameraImage& image, int column, int row) {
    const std::size_t at = 3 * (static_cast<std::size_t>(row) * image.width + column);
    return {image.pixels[at], image.pixels[at + 1], image.pixels[at + 2]};
}

bool is_red(const std::array<int, 3>& p) { return p[0] > 2 * p[1] && p[0] > 2 * p[2]; }
bool is_blue(const std::array<int, 3>& p) { return p[2] > 2 * p[0] && p[2] > 2 * p[1]; }

BoxSpec block(double x, double y, const char* color, double size = 0.2) {
    return {.at = {x, y, size / 2}, .size = {size, size, size}, .color = color};
}

}  // namespace

TEST_CASE("a picture's bytes agree with its size and format", "[sim][camera]") {
    TryWorld w;
    const CameraImage color = shoot(*w.world, {.at = {0, 0, 0.1}}, {.width = 320, .height = 200});
    CHECK(color.width == 320);
    CHECK(color.height == 200);
    CHECK(color.bpp == 24);
    CHECK(color.format == "rgb8");
    CHECK(color.pixels.size() == 320 * 200 * 3);
    const CameraImage gray = shoot(*w.world, {.at = {0, 0, 0.1}}, {.width = 33, .height = 17, .color = false});
    CHECK(gray.bpp == 8);
    CHECK(gray.format == "gray8");
    CHECK(gray.pixels.size() == 33 * 17);
}

TEST_CASE("each camera has its own lens, whichever was opened before", "[sim][camera]") {
    ArenaSpec arena;
    arena.boxes = {block(1, 0.3, "red")};
    TryWorld w(arena);
    const auto picture = [&](double k1) { return shoot(*w.world, {.at = {0, 0, 0.1}}, {.k1 = k1}).pixels; };
    const auto pinhole = picture(0), barrel = picture(-0.2), pincushion = picture(0.2);
    CHECK(barrel != pinhole);
    CHECK(pincushion != pinhole);
    CHECK(pincushion != barrel);
    CHECK(picture(0.2) == pincushion);
    CHECK(picture(-0.2) == barrel);
    CHECK(picture(0) == pinhole);
}

TEST_CASE("the floor is below the horizon, and the sky above it", "[sim][camera]") {
    TryWorld w;
    const CameraImage image = shoot(*w.world, {.at = {0, 0, 0.1}});
    CHECK(pixel(image, 320, 10)[2] > pixel(image, 320, 10)[0]);    // bluish
    CHECK(pixel(image, 320, 470)[2] < pixel(image, 320, 470)[0]);  // brownish
    CHECK(pixel(image, 320, 235) == pixel(image, 320, 10));
    CHECK(pixel(image, 320, 245) == pixel(image, 320, 470));
}

TEST_CASE("objects on the left appear on the left, and nearer ones hide farther ones in any order of drawing",
          "[sim][camera]") {
    ArenaSpec arena;
    arena.boxes = {block(1, 0.3, "#ff0000"), block(1, -0.3, "#0000ff"), block(0.6, 0, "#ff0000", 0.1),
                   block(1, 0, "#0000ff")};
    TryWorld w(arena);
    const CameraImage image = shoot(*w.world, {.at = {0, 0, 0.05}});
    CHECK(is_red(pixel(image, 120, 230)));
    CHECK(is_blue(pixel(image, 520, 230)));
    CHECK(is_red(pixel(image, 320, 240)));
    CHECK(is_blue(pixel(image, 320, 170)));  // looks out behind the smaller one
}

TEST_CASE("a picture does not depend on the camera's place in the world", "[sim][camera]") {
    const auto seen_at = [](double x, double y) {
        ArenaSpec arena;
        arena.boxes = {block(1 + x, 0.3 + y, "#ff0000"), block(0.8 + x, -0.3 + y, "#0000ff")};
        arena.cylinders = {{.at = {0.7 + x, 0.02 + y, 0.05}, .radius = 0.05, .height = 0.1, .color = "#00ff00"}};
        TryWorld w(arena);
        return shoot(*w.world, {.at = {x, y, 0.25}}, {.width = 320, .height = 240});
    };
    const CameraImage here = seen_at(0, 0);
    for (const auto& [x, y] : {std::pair{6.0, -9.0}, {-7.0, 5.0}, {-4.0, -8.0}}) {
        const CameraImage there = seen_at(x, y);
        REQUIRE(there.pixels.size() == here.pixels.size());
        std::size_t others = 0;
        for (std::size_t i = 0; i < here.pixels.size(); ++i) others += here.pixels[i] != there.pixels[i] ? 1 : 0;
        CAPTURE(x, y);
        CHECK(others < 200);  // of 230 400 pixels: an edge may be rounded differently
    }
}

TEST_CASE("an edge is at the pixel that the pinhole model computes", "[sim][camera]") {
    ArenaSpec arena;
    arena.boxes = {{.at = {1.05, 0.05, 0.5}, .size = {0.1, 0.1, 1.0}, .color = "#ff0000"}};  // from y = 0 to 0.1
    TryWorld w(arena);
    const CameraImage image = shoot(*w.world, {.at = {0, 0, 0.5}}, {.field_of_view = 1.0});
    const CameraIntrinsics c = pinhole(640, 480, 1.0);
    const int edge = static_cast<int>(std::lround(c.cx - c.fx * 0.1));
    CHECK_FALSE(is_red(pixel(image, edge - 1, 240)));
    CHECK(is_red(pixel(image, edge + 1, 240)));
    CHECK(is_red(pixel(image, 319, 240)));
    CHECK_FALSE(is_red(pixel(image, 320, 240)));
}

TEST_CASE("a camera moves with its robot and does not see it", "[sim][camera]") {
    ArenaSpec arena;
    arena.boxes = {block(0, 1, "#ff0000")};
    TryWorld w(arena);
    w.add(mouse_spec(), 0, 0, M_PI / 2, "mouse");
    w.add(mouse_spec(), 0.4, 0, 0, "other");
    const CameraMount ahead{.robot = "mouse", .at = {0, 0, 0.05}};
    CHECK(is_red(pixel(shoot(*w.world, ahead), 320, 240)));
    CameraMount right = ahead;
    right.yaw = -M_PI / 2;
    const auto seen = pixel(shoot(*w.world, right), 320, 240);
    CHECK(seen[0] < 120);  // the other robot, dark
    CameraMount left = ahead;
    left.yaw = M_PI / 2;
    CHECK(pixel(shoot(*w.world, left), 320, 200)[0] > 200);  // the sky
    CameraMount down = ahead;
    down.pitch = 1.5;
    CHECK(pixel(shoot(*w.world, down), 320, 240)[0] > pixel(shoot(*w.world, down), 320, 240)[2]);  // the floor
}

TEST_CASE("a camera sees the lit LEDs of a robot, the first on the left, from the next step on", "[sim][camera]") {
    TryWorld w;
    const RobotId id = w.add(mouse_spec(), 0.3, 0);
    // A camera behind the robot. Its LEDs are between these columns.
    const auto reds = [&] {
        const CameraImage image = shoot(*w.world, {.at = {0, 0, 0.12}});
        std::set<int> columns;
        for (int row = 0; row < image.height; ++row) {
            for (int column = 0; column < image.width; ++column) {
                if (is_red(pixel(image, column, row))) columns.insert(column);
            }
        }
        return columns;
    };
    w.run(0.01);
    CHECK(reds().empty());
    w.bodies[id]->set_leds({true, false, false, false});
    CHECK(reds().empty());
    w.run(0.01);
    const std::set<int> first = reds();
    REQUIRE_FALSE(first.empty());
    CHECK(*first.rbegin() < 320);
    CHECK(first.size() < 30);
    w.bodies[id]->set_leds({false, false, false, true});
    w.run(0.01);
    const std::set<int> last = reds();
    REQUIRE_FALSE(last.empty());
    CHECK(*last.begin() > 320);
    w.bodies[id]->set_leds({false, false, false, false});
    w.run(0.01);
    CHECK(reds().empty());
}

TEST_CASE("a camera on an unknown robot and the move of an unknown marker are refused", "[sim][camera]") {
    ArenaSpec arena;
    arena.markers.push_back({.name = "target", .id = 1, .at = {1, 0, 0.1}});
    TryWorld w(arena);
    const auto camera = w.world->open_camera({.robot = "mouse"}, {});
    REQUIRE_FALSE(camera);
    CHECK(camera.error().message == "there is no robot 'mouse' that could carry a camera");
    CHECK(w.world->move_marker("targt", {}).error().message == "there is no marker 'targt' (did you mean 'target'?)");
    CHECK(w.world->move_marker("target", {{NAN, 0, 0}, {}}).error().message ==
          "marker 'target': its pose: expected a finite number, got nan");
    REQUIRE(w.world->move_marker("target", {{2, 1, 0.3}, {.y = 0.5}}));
    REQUIRE(w.world->markers().size() == 1);
    CHECK(w.world->markers()[0].pose.position == Point3D{2, 1, 0.3});
}

TEST_CASE("a floor's picture lies on the floor: its top where y is largest", "[sim][camera]") {
    // 2 x 2 pixels: red, green / blue, white.
    const unsigned char png[] = {0x89, 0x50, 0x4e, 0x47, 0xd,  0xa,  0x1a, 0xa,  0x0,  0x0,  0x0,  0xd,  0x49,
                                 0x48, 0x44, 0x52, 0x0,  0x0,  0x0,  0x2,  0x0,  0x0,  0x0,  0x2,  0x8,  0x2,
                                 0x0,  0x0,  0x0,  0xfd, 0xd4, 0x9a, 0x73, 0x0,  0x0,  0x0,  0x12, 0x49, 0x44,
                                 0x41, 0x54, 0x78, 0x9c, 0x63, 0xf8, 0xcf, 0xc0, 0xc0, 0x0,  0xc2, 0xc,  0xff,
                                 0x81, 0x0,  0x0,  0x1f, 0xee, 0x5,  0xfb, 0xb,  0xd9, 0x68, 0x8b, 0x0,  0x0,
                                 0x0,  0x0,  0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
    const auto folder = std::filesystem::temp_directory_path() / "nezumi_floor_test";
    std::filesystem::create_directories(folder);
    const auto file = (folder / "floor.png").string();
    std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(png), sizeof png);
    ArenaSpec arena;
    arena.floor = FloorSpec{.image = file, .size = {2, 2}};
    TryWorld w(arena);
    // From above, with the top of the picture where y is largest.
    const CameraImage image = shoot(*w.world, {.at = {0, 0, 2}, .yaw = M_PI / 2, .pitch = M_PI / 2});
    CHECK(pixel(image, 220, 140) == std::array{255, 0, 0});
    CHECK(pixel(image, 420, 140) == std::array{0, 255, 0});
    CHECK(pixel(image, 220, 340) == std::array{0, 0, 255});
    CHECK(pixel(image, 420, 340) == std::array{255, 255, 255});
    // Its pixels meet in the middle of the image; it ends 1 m to the left, and beyond the image above.
    CHECK(pixel(image, 319, 140) == std::array{255, 0, 0});
    CHECK(pixel(image, 320, 140) == std::array{0, 255, 0});
    CHECK(pixel(image, 220, 5) == std::array{255, 0, 0});
    CHECK(pixel(image, 35, 140) == std::array{255, 0, 0});
    CHECK_FALSE(pixel(image, 15, 140) == std::array{255, 0, 0});

    std::ofstream(file, std::ios::binary) << "no picture";
    arena.floor->place = {"a.lua", 3, 0};
    const auto refused = make_world(arena, {}, {});
    REQUIRE_FALSE(refused);
    CHECK(refused.error().message.find("floor: '" + file + "' can't be read as a PNG: ") == 0);
    CHECK(refused.error().place == Place{"a.lua", 3, 0});
    std::filesystem::remove_all(folder);
}

TEST_CASE("a camera applies the blur and noise of its settings, and the noise depends on the tick", "[sim][camera]") {
    ArenaSpec arena;
    arena.boxes = {block(1, 0.3, "#ff0000"), block(0.8, -0.2, "#0000ff")};
    TryWorld w(arena);
    const CameraMount mount{.at = {0, 0, 0.05}};
    for (const bool color : {true, false}) {
        const CameraImage clean = shoot(*w.world, mount, {.width = 150, .height = 100, .color = color});
        Octets expected = clean.pixels;
        blur_picture(expected, 150, 100, color ? 3 : 1, 1.5);
        CHECK(shoot(*w.world, mount, {.width = 150, .height = 100, .color = color, .blur = 1.5}).pixels == expected);
        ImageNoise(8, 42).add_to(expected, color ? 450 : 150, 0);
        const CameraSettings both{
            .width = 150, .height = 100, .field_of_view = 1.0, .color = color, .noise = 8, .blur = 1.5, .seed = 42};
        CHECK(shoot(*w.world, mount, both).pixels == expected);
        auto camera = w.world->open_camera(mount, both);
        REQUIRE(camera);
        CameraImage later, again;
        (*camera)->expose({.tick = 7});
        (*camera)->develop(later);
        (*camera)->expose({.tick = 0});
        (*camera)->develop(again);
        CHECK(later.pixels != expected);
        CHECK(again.pixels == expected);
    }
}

TEST_CASE("painting writes every pixel and nothing beyond, for any scene", "[sim][camera]") {
    ArenaSpec arena;
    for (int i = 0; i < 12; ++i) {
        const double angle = 0.5 * i;
        arena.boxes.push_back({.at = {0.06 * std::cos(angle), 0.06 * std::sin(angle), 0.1},
                               .size = {0.1, 3.0, 0.2},
                               .yaw = angle,
                               .pitch = 0.3 * i});
        arena.cylinders.push_back({.at = {0.1 * i, 0.02, 0}, .radius = 0.05, .height = 0.3});
        arena.markers.push_back({.name = std::to_string(i), .id = i, .at = {0.02 * i, 0, 0.1}, .facing = angle});
    }
    TryWorld w(arena);
    for (int i = 0; i < 50; ++i) {
        const CameraMount mount{.at = {0.01 * i, 0, 0.02 * i - 0.2}, .yaw = 0.3 * i, .pitch = 0.05 * i - 1.2};
        CHECK(shoot(*w.world, mount, {.width = 61, .height = 37}).pixels.size() == 61 * 37 * 3);
    }
}

TEST_CASE("a camera needs a world, an existing robot and a rate possible with the tick", "[sim][camera]") {
    System bare({.rate = 100}, {});
    CHECK(make_simulated_camera({.name = "eye", .type = "Camera"}, bare).error().message ==
          "component 'eye': a Camera needs a world to look at");
    System system({.rate = 100}, {});
    system.take_world(std::move(*make_world({}, {}, {})));
    CHECK(make_simulated_camera({.name = "eye", .type = "Camera", .on = "mouse"}, system).error().message ==
          "component 'eye': on: there is no robot 'mouse' before it");
    CHECK(make_simulated_camera({.name = "eye", .type = "Camera", .config = {{"frame_rate", 200.0}}}, system)
              .error()
              .message == "component 'eye': frame_rate 200 Hz is above the tick's 100 Hz");
    auto eye = make_simulated_camera({.name = "eye", .type = "Camera"}, system);
    REQUIRE(eye);
    REQUIRE((*eye)->parameters().set("frame_rate", 200.0));
    const auto added = system.add(std::move(*eye));
    REQUIRE(added);
    CHECK((*added)->activate(system.now()).error().message ==
          "eye went to ERROR: frame_rate 200 Hz is above the tick's 100 Hz");
}

TEST_CASE("a camera takes no more pictures than its component's rate allows", "[sim][camera]") {
    System system({.rate = 100}, {});
    system.take_world(std::move(*make_world({}, {}, {})));
    const ParameterValues small{{"width", std::int64_t{160}}, {"height", std::int64_t{120}}, {"latency", 0.0}};
    auto eye = make_simulated_camera({.name = "eye", .type = "Camera", .config = small, .rate = 5}, system);
    REQUIRE(eye);
    REQUIRE((*eye)->parameters().set_all(small));
    Component& added = **system.add(std::move(*eye));
    REQUIRE(added.activate(system.now()));
    std::set<double> taken;
    for (int i = 0; i < 200; ++i) {
        system.tick();
        if (added.find_out_port("out")->tm() > 0) taken.insert(added.find_out_port("out")->tm());
    }
    CHECK(taken.size() >= 9);
    CHECK(taken.size() <= 11);
}
