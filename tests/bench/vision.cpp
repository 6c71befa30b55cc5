// A simulated camera and the marker detector: how far off the positions are, and what a picture costs.
//
// Aims: the median error at 1 m and 640 x 480 is under 5 mm; 30 pictures a second leave one core time to spare.
// Measured (two shared cores): 1.0 mm at 1 m; 2.2 ms to paint a picture, 7 ms more with noise and blur, 1.4 ms to find
// tags, 0.25 ms for each tag in sight.
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <string>

#include "engine/devices/camera.hpp"
#include "engine/vision/tag_finder.hpp"
#include "sim/world.hpp"
#include "tests/bench/report.hpp"

using namespace nezumi;

namespace {

constexpr double field_of_view = 1.0472;
constexpr double pi = std::numbers::pi;
constexpr int width = 640, height = 480;
constexpr Point3D eye{0, 0, 0.15};

// A room with things in it and `markers` markers.
ArenaSpec room(int markers) {
    ArenaSpec arena;
    arena.size = Point2D{5, 5};
    for (int i = 0; i < 8; ++i) {
        const double angle = 2 * pi * i / 8;
        arena.boxes.push_back({.at = {2.3 * std::cos(angle), 2.3 * std::sin(angle), 0.1},
                               .size = {0.2, 0.2, 0.2},
                               .yaw = angle,
                               .color = i % 2 == 0 ? "#d6453d" : "#3568c4"});
        arena.cylinders.push_back(
            {.at = {2.2 * std::cos(angle + 0.3), 2.2 * std::sin(angle + 0.3), 0.1}, .radius = 0.05, .height = 0.2});
    }
    for (int i = 0; i < markers; ++i) {
        const int column = i % 3 - 1, row = i / 3;
        arena.markers.push_back({.name = "marker" + std::to_string(i),
                                 .id = i,
                                 .size = 0.1,
                                 .at = {1, 0.2 * column, 0.15 + 0.2 * row},
                                 .facing = pi});
    }
    return arena;
}

struct Flaws {
    const char* name;
    double noise, blur;
};

struct Shot {
    Shot(World& world, const Flaws& flaws)
        : camera(std::move(*world.open_camera({.at = eye}, {.width = width,
                                                            .height = height,
                                                            .field_of_view = field_of_view,
                                                            .noise = flaws.noise,
                                                            .blur = flaws.blur,
                                                            .seed = 1}))) {}
    GrayImage take() {
        camera->expose({tick++, 0});
        camera->develop(image);
        return std::move(*to_gray(image));
    }
    std::unique_ptr<CameraSource> camera;
    CameraImage image;
    std::int64_t tick = 0;
};

// Errors [m] of positions at this distance: anywhere in the middle of the picture, turned by up to 0.6 rad.
std::vector<double> errors_at(double distance, const Flaws& flaws, int count, int& missed) {
    auto world = std::move(*sim::make_world(room(1), {}, {}));
    Shot shot(*world, flaws);
    TagFinder finder("36h11");
    std::mt19937 random(7);  // the engine's own sequence is the same everywhere
    const auto draw = [&](double reach) { return reach * (2 * static_cast<double>(random()) / 4294967295.0 - 1); };
    std::vector<double> errors;
    for (int i = 0; i < count; ++i) {
        const double bearing = draw(0.3), climb = draw(0.1);
        const Point3D from_eye{distance * std::cos(bearing) * std::cos(climb),
                               distance * std::sin(bearing) * std::cos(climb), distance * std::sin(climb)};
        const Point3D at{eye.x + from_eye.x, eye.y + from_eye.y, eye.z + from_eye.z};
        static_cast<void>(world->move_marker("marker0", {at, {.y = pi + bearing + draw(0.6)}}));
        GrayImage gray = shot.take();
        const auto tags = finder.find(gray, Intrinsics::of(width, height, field_of_view), 0.1);
        if (tags.empty()) {
            ++missed;
            continue;
        }
        const Point3D& seen = tags.front().pose.position;
        errors.push_back(std::hypot(seen.x - from_eye.x, seen.y - from_eye.y, seen.z - from_eye.z));
    }
    return errors;
}

struct Cost {
    double render, gray_and_find;  // [s]
};

Cost cost_of(int markers, const Flaws& flaws, int rounds) {
    auto world = std::move(*sim::make_world(room(markers), {}, {}));
    Shot shot(*world, flaws);
    TagFinder finder("36h11");
    std::vector<double> render, find;
    for (int i = 0; i < rounds; ++i) {
        render.push_back(bench::time_of([&] {
            shot.camera->expose({i, 0});
            shot.camera->develop(shot.image);
        }));
        find.push_back(bench::time_of([&] {
            auto gray = to_gray(shot.image);
            static_cast<void>(finder.find(*gray, Intrinsics::of(width, height, field_of_view), 0.1));
        }));
    }
    return {bench::median(render), bench::median(find)};
}

}  // namespace

int main(int argc, char** argv) {
    const int rounds = argc > 1 ? std::max(3, std::atoi(argv[1])) : 100;
    bench::print_header("A simulated camera and the marker detector",
                        std::to_string(width) + " x " + std::to_string(height) +
                            ", 60 degrees, marker of 0.1 m (36h11), a room with 16 things, " + std::to_string(rounds) +
                            " pictures each");
    const Flaws all_flaws[] = {{"clean", 0, 0}, {"noise 2, blur 0.7", 2, 0.7}, {"noise 8, blur 1.2", 8, 1.2}};

    std::printf("  error of the position [mm]        0.3 m            0.5 m            1 m              2 m\n");
    std::printf("                                median   worst\n");
    double worst_median = 0;
    for (const Flaws& flaws : all_flaws) {
        std::printf("  %-22s", flaws.name);
        for (const double distance : {0.3, 0.5, 1.0, 2.0}) {
            int missed = 0;
            const auto errors = errors_at(distance, flaws, rounds, missed);
            if (errors.empty()) {
                std::printf("   none found    ");
                continue;
            }
            const double median = bench::median(errors);
            if (distance == 1.0 && flaws.noise <= 2) worst_median = std::max(worst_median, median);
            std::printf("   %6.2f %7.2f", 1e3 * median, 1e3 * *std::max_element(errors.begin(), errors.end()));
            if (missed > 0) std::printf(" (-%d)", missed);
        }
        std::printf("\n");
    }
    std::printf("  at 1 m the median is at most %.2f mm: %s (aim 5 mm)\n\n", 1e3 * worst_median,
                bench::verdict(worst_median, 0.005));

    std::printf("  milliseconds of one core      render   find   each tag: decoding and pose\n");
    double most = 0;
    for (const Flaws& flaws : all_flaws) {
        const Cost one = cost_of(1, flaws, rounds), nine = cost_of(9, flaws, rounds);
        std::printf("  %-26s %8.2f %6.2f   %6.3f\n", flaws.name, 1e3 * one.render, 1e3 * one.gray_and_find,
                    1e3 * (nine.gray_and_find - one.gray_and_find) / 8);
        most = std::max(most, one.render + one.gray_and_find);
    }
    std::printf("  a picture costs at most %.2f ms of the 33.3 ms that it has: %s\n", 1e3 * most,
                bench::verdict(most, 1.0 / 30));
    return worst_median <= 0.005 && most <= 1.0 / 30 ? 0 : 1;
}
