// Pictures, painted by hand or of a simulated camera, and what detectors see in them, for the tests of vision/.
#pragma once

#include <catch2/catch.hpp>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/devices/camera.hpp"
#include "engine/system/system.hpp"
#include "engine/trace/trace_hash.hpp"
#include "engine/vision/image_component.hpp"
#include "engine/vision/one_thread.hpp"
#include "engine/vision/tag_finder.hpp"
#include "engine/world/camera_source.hpp"
#include "sim/world.hpp"

namespace nezumi {

/// As in detectors; the thread sanitizer does not know the locks of OpenCV's threads.
inline const bool has_one_thread = use_one_thread();

inline constexpr double field_of_view = 1.0472;

inline std::unique_ptr<World> world_with(const ArenaSpec& arena) {
    auto world = sim::make_world(arena, {.step = 0.005, .seed = 1}, {});
    INFO((world ? "" : world.error().message));
    REQUIRE(world);
    return std::move(*world);
}

inline ArenaSpec one_marker(Point3D at = {1, 0, 0.1}, double facing = M_PI, double size = 0.1) {
    ArenaSpec arena;
    arena.markers.push_back({.name = "target", .id = 7, .size = size, .at = at, .facing = facing});
    return arena;
}

/// The picture of a camera 0.1 m above the origin, looking along x.
inline CameraImage picture_of(World& world, CameraSettings settings = {.field_of_view = field_of_view},
                              CameraMount mount = {.at = {0, 0, 0.1}}) {
    auto camera = world.open_camera(mount, settings);
    REQUIRE(camera);
    CameraImage image;
    (*camera)->expose({});
    (*camera)->develop(image);
    return image;
}

inline std::vector<FoundTag> tags_in(const CameraImage& image, double size = 0.1) {
    auto gray = to_gray(image);
    REQUIRE(gray);
    return TagFinder("36h11").find(*gray, pinhole(image.width, image.height, field_of_view), size);
}

inline FoundTag only_tag(World& world, double size = 0.1) {
    const auto tags = tags_in(picture_of(world), size);
    REQUIRE(tags.size() == 1);
    return tags.front();
}

struct Color {
    std::uint8_t red, green, blue;
};

/// A picture painted by hand: a background with rectangles, as far as they are within it.
class Canvas {
public:
    Canvas(int width, int height, Color ground)
        : image_{.width = static_cast<std::uint16_t>(width),
                 .height = static_cast<std::uint16_t>(height),
                 .bpp = 24,
                 .format = "rgb8",
                 .fDiv = 1,
                 .pixels = Octets(static_cast<std::size_t>(width * height * 3))} {
        paint(0, 0, width, height, ground);
    }
    Canvas& paint(int left, int top, int width, int height, Color color) {
        return paint_where(color,
                           [&](int x, int y) { return x >= left && x < left + width && y >= top && y < top + height; });
    }
    template <class Where>
    Canvas& paint_where(Color color, const Where& where) {
        for (int y = 0; y < image_.height; ++y) {
            for (int x = 0; x < image_.width; ++x) {
                if (!where(x, y)) continue;
                std::uint8_t* pixel = &image_.pixels[static_cast<std::size_t>(3 * (y * image_.width + x))];
                pixel[0] = color.red;
                pixel[1] = color.green;
                pixel[2] = color.blue;
            }
        }
        return *this;
    }
    const CameraImage& image() const { return image_; }
    ColorImage colors() const { return *to_rgb(image_); }
    GrayImage grays() const { return *to_gray(image_); }

private:
    CameraImage image_;
};

/// A camera "eye" that stands in the arena, and a component "detector" that processes its pictures.
template <class Detector>
struct Watched {
    explicit Watched(const ArenaSpec& arena, const ParameterValues& detector_values = {},
                     const ParameterValues& camera_values = {}, bool connected = true)
        : system({.rate = 100}, [this](const LogLine& line) { said.push_back(line.text); }) {
        system.take_world(world_with(arena));
        system.observe(hash);
        ComponentEntry eye{.name = "eye", .type = "Camera", .at = {0, 0, 0.1}};
        add(make_simulated_camera(eye, system), camera_values);
        add(make_image_component<Detector>({.name = "detector"}, system), detector_values);
        if (connected) REQUIRE(system.connect("eye.out", "detector.image"));
        for (const auto& component : system.components()) REQUIRE(component->activate(system.now()));
    }

    void add(Expected<std::unique_ptr<Component>> component, const ParameterValues& values) {
        REQUIRE(component);
        REQUIRE((*component)->parameters().set_all(values));
        REQUIRE(system.add(std::move(*component)));
    }
    void run(int ticks) {
        for (int i = 0; i < ticks; ++i) system.tick();
    }
    void show(const CameraImage& image) { detector().find_in_port("image")->inject(image); }
    Component& detector() { return *system.find("detector"); }
    const Port& port(const char* name) { return *detector().find_out_port(name); }
    template <class T>
    T value(const char* name) {
        return port(name).value().template get<T>();
    }
    bool visible() { return value<bool>("visible"); }

    std::vector<std::string> said;
    TraceHash hash;
    System system;
};

/// A parameter accepts both of its bounds and nothing beyond them.
inline void check_bounds(Component& component, const char* name, double low, double high) {
    INFO(name);
    Parameters& parameters = component.parameters();
    const double hair = 1e-6 * high;
    CHECK(parameters.set(name, low));
    CHECK(parameters.set(name, high));
    CHECK_FALSE(parameters.set(name, low - hair));
    CHECK_FALSE(parameters.set(name, high + hair));
}

}  // namespace nezumi
