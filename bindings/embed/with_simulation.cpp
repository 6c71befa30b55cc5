// The only place that combines the rooms of a simulated system.
#include <utility>

#include "bindings/embed/simulation.hpp"
#include "bindings/lua/reload/lua_host.hpp"
#include "engine/devices/camera.hpp"
#include "engine/devices/joystick.hpp"
#include "engine/devices/wired_device.hpp"
#include "engine/vision/color_detector.hpp"
#include "engine/vision/line_detector.hpp"
#include "engine/vision/marker_detector.hpp"
#include "sim/world.hpp"

namespace nezumi {

LiveOptions simulated_systems(std::vector<std::filesystem::path> installed) {
    LiveOptions live{.scripts = &lua_scripts(),
                     .installed = std::move(installed),
                     .world = sim::make_world,
                     .components = {{"Camera", {{"sim", make_simulated_camera}}},
                                    {"ColorDetector", {{"sim", make_image_component<ColorDetector>}}},
                                    {"Joystick", {{"sim", make_joystick}}},
                                    {"LineDetector", {{"sim", make_image_component<LineDetector>}}},
                                    {"MarkerDetector", {{"sim", make_image_component<MarkerDetector>}}}}};
    add_simulated_devices(live.components);
    return live;
}

void keep_sounds(LiveOptions& live, const std::string& folder) { live.world = sim::make_worlds_with_sound(folder); }

}  // namespace nezumi
