// Calibration of a camera whose lens differs from its model.
#include "hw/calibrate/camera.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "engine/vision/tag_finder.hpp"
#include "engine/world/chessboard.hpp"
#include "engine/world/world.hpp"
#include "sim/world.hpp"
#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;
using namespace nezumi::hw;

namespace {

const CameraSettings camera_model{.field_of_view = 1.0472};
// A lens like that of cheap webcams, and a noisy sensor.
const CameraSettings truth{.field_of_view = 1.16,
                           .k1 = -0.24,
                           .k2 = 0.08,
                           .p1 = 0.002,
                           .p2 = -0.001,
                           .k3 = -0.01,
                           .color = false,
                           .noise = 2,
                           .blur = 0.5};

CameraImage shoot(World& world, const CameraMount& mount, const CameraSettings& settings) {
    auto camera = world.open_camera(mount, settings);
    REQUIRE(camera);
    CameraImage image;
    (*camera)->expose({});
    (*camera)->develop(image);
    return image;
}

std::unique_ptr<World> world_with(const ArenaSpec& arena) {
    return std::move(*sim::make_world(arena, {.step = 0.005, .seed = 1}, nullptr));
}

// Shows the board of `boards`, each view twice, as if a person held it still.
Expected<IntrinsicsFit> calibrated(const std::function<CameraMount(int view)>& view, BoardCourse course = {}) {
    ArenaSpec arena;
    arena.boxes = chessboard({});
    const auto world = world_with(arena);
    int count = 0;
    return calibrate_camera(
        course,
        [&]() -> Expected<TimedPicture> {
            const int number = count++;
            return TimedPicture{shoot(*world, view(number / 2), truth), 0.5 * number};
        },
        [](const std::string&) {});
}
CameraMount all_around(int view) { return view_of_chessboard({}, view); }

// The pixel of this direction (x to the right, y down, z = 1).
Point2D pixel_of(const CameraIntrinsics& c, double a, double b) {
    const double r2 = a * a + b * b, radial = 1 + r2 * (c.k1 + r2 * (c.k2 + r2 * c.k3));
    return {c.cx + c.fx * (a * radial + 2 * c.p1 * a * b + c.p2 * (r2 + 2 * a * a)),
            c.cy + c.fy * (b * radial + c.p1 * (r2 + 2 * b * b) + 2 * c.p2 * a * b)};
}

// [px] mean error of these intrinsics over the picture without its outermost corners.
double pixel_error(const CameraIntrinsics& believed) {
    double sum = 0;
    int count = 0;
    for (double a = -0.6; a < 0.61; a += 0.05) {
        for (double b = -0.45; b < 0.46; b += 0.05) {
            const Point2D is = pixel_of(truth.raw_intrinsics(), a, b), said = pixel_of(believed, a, b);
            if (is.x < 0 || is.x > 639 || is.y < 0 || is.y > 479) continue;
            sum += std::hypot(is.x - said.x, is.y - said.y);
            ++count;
        }
    }
    return sum / count;
}

// [m] mean error of markers found with these intrinsics.
double marker_error(const CameraIntrinsics& believed) {
    double sum = 0;
    int count = 0;
    for (const double side : {-0.3, -0.15, 0.0, 0.2, 0.3}) {
        ArenaSpec arena;
        arena.markers.push_back({.name = "target", .id = 7, .size = 0.1, .at = {0.7, side, 0.2}, .facing = M_PI});
        const auto world = world_with(arena);
        auto gray = to_gray(shoot(*world, {.at = {0, 0, 0.1}}, truth));
        REQUIRE(gray);
        const auto tags = TagFinder("36h11").find(*gray, believed, 0.1);
        REQUIRE(tags.size() == 1);
        const Point3D& at = tags[0].pose.position;
        sum += std::hypot(at.x - 0.7, at.y - side, at.z - 0.1);
        ++count;
    }
    return sum / count;
}

}  // namespace

TEST_CASE("a calibrated camera has less than a fifth of its model's error", "[hw][calibration][camera]") {
    const auto fit = calibrated(all_around);
    INFO((fit ? "" : fit.error().message));
    REQUIRE(fit);
    const double pixels = pixel_error(fit->intrinsics), pixels_before = pixel_error(camera_model.raw_intrinsics());
    const double metres = marker_error(fit->intrinsics), metres_before = marker_error(camera_model.raw_intrinsics());
    CAPTURE(pixels, pixels_before, metres, metres_before);
    CHECK(pixels_before > 5);
    CHECK(pixels < pixels_before / 5);
    CHECK(metres_before > 0.02);
    CHECK(metres < metres_before / 5);
    CHECK(fit->error < 0.5);
    WARN("pixels off by " << pixels_before << ", calibrated " << pixels << "; markers by " << metres_before * 1e3
                          << " mm, calibrated " << metres * 1e3 << " mm");
}

TEST_CASE("views that are all alike do not determine the lens and are refused", "[hw][calibration][camera]") {
    // Views from directly above, only moved.
    const auto fit = calibrated(
        [](int view) {
            const ChessboardSpec board;
            return CameraMount{
                .at = {board.at.x - 0.07 + 0.035 * (view % 5), board.at.y - 0.04 + 0.035 * (view / 5), 0.45},
                .pitch = M_PI / 2};
        },
        {.views = 8});
    REQUIRE_FALSE(fit);
    INFO(fit.error().message);
    CHECK(fit.error().message ==
          "the views are too similar to determine the focal length: hold the board tilted, to all sides, by 30 degrees "
          "or "
          "more");
}

TEST_CASE("a board that never moves, or is not there, ends the calibration after a while",
          "[hw][calibration][camera]") {
    const auto fit = calibrated([](int) { return view_of_chessboard({}, 1); }, {.patience = 3});
    REQUIRE_FALSE(fit);
    CHECK(fit.error().message ==
          "no new view of the board for 3 s, 1 of 20 were taken: is all of it in the picture, has it 9 x 6 inner "
          "corners and a white margin, is it bright enough?");
    const auto other = calibrated(all_around, {.board = {.columns = 7, .rows = 4}, .patience = 3});
    REQUIRE_FALSE(other);
    CHECK(other.error().message ==
          "no new view of the board for 3 s, 0 of 20 were taken: is all of it in the picture, has it 7 x 4 inner "
          "corners and a white margin, is it bright enough?");
}

TEST_CASE("a camera's calibration in simulation writes nothing", "[hw][calibration][camera]") {
    const Scratch scratch;
    scratch.write("system.lua",
                  "robot 'mouse' { model = 'raspimouse' }\n"
                  "component 'eye' { type = 'Camera', on = 'mouse', config = { k1 = -0.2, format = 'gray8' } }");
    const Outcome outcome = run_nezumi({"calibrate", "camera", "system.lua", "--sim"}, scratch.path("").string());
    CHECK(outcome.status == 0);
    CHECK(outcome.out.starts_with("fx 55"));
    CHECK(outcome.out.find(", k1 -0.") != std::string::npos);
    CHECK(outcome.out.ends_with("nothing is written, because this was a simulation\n"));
    CHECK(outcome.error.find("view 20 of 20\n") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(scratch.path("mouse.calibration.lua")));
}

TEST_CASE("a camera that can't be calibrated is refused in one line", "[hw][calibration][camera]") {
    const Scratch scratch;
    const std::string folder = scratch.path("").string();
    const std::string mouse = "robot 'mouse' { model = 'raspimouse' }\n";
    scratch.write("none.lua", mouse);
    scratch.write("free.lua", mouse + "component 'eye' { type = 'Camera' }");
    scratch.write("one.lua", mouse + "component 'eye' { type = 'Camera', on = 'mouse' }");
    scratch.write("two.lua", mouse +
                                 "component 'left' { type = 'Camera', on = 'mouse' }\n"
                                 "component 'right' { type = 'Camera', on = 'mouse' }");
    const auto said = [&](std::vector<std::string> words) {
        words.insert(words.begin(), {"calibrate", "camera"});
        const Outcome outcome = run_nezumi(std::move(words), folder);
        CHECK(outcome.status == 2);
        return outcome.error;
    };
    CHECK(said({"none.lua", "--sim"}) == "nezumi: none.lua has no camera\n");
    CHECK(said({"two.lua", "--sim"}) ==
          "nezumi: two.lua has several cameras: choose one by --camera, of left, right\n");
    CHECK(said({"two.lua", "--sim", "--camera", "lefft"}) ==
          "nezumi: there is no camera 'lefft' in two.lua (did you mean 'left'?)\n");
    CHECK(said({"free.lua", "--sim"}) ==
          "free.lua:2: camera 'eye' is not on a robot, so it has no calibration file: add on = \"NAME\"\n");
    CHECK(said({"one.lua"}) ==
          "nezumi: a person must stand beside the robot: run this command in a terminal, or add --yes\n");
    CHECK(said({"one.lua", "--sim", "--board", "9"})
              .find("expected the numbers of inner corners as COLUMNSxROWS, each from 3 to 50, as in 9x6") !=
          std::string::npos);
}
