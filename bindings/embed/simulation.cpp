// The one place that joins the rooms of a simulated system.
#include "bindings/embed/simulation.hpp"

#include <cmath>
#include <utility>

#include "engine/devices/camera.hpp"
#include "engine/devices/joystick.hpp"
#include "engine/vision/color_detector.hpp"
#include "engine/vision/line_detector.hpp"
#include "engine/vision/marker_detector.hpp"
#include "sim/world.hpp"

namespace nezumi {

LiveOptions simulated_systems(std::vector<std::filesystem::path> installed) {
    return {.installed = std::move(installed),
            .world = sim::make_world,
            .components = {{"Camera", {{"sim", make_simulated_camera}}},
                           {"ColorDetector", {{"sim", make_image_component<ColorDetector>}}},
                           {"Joystick", {{"sim", make_joystick}}},
                           {"LineDetector", {{"sim", make_image_component<LineDetector>}}},
                           {"MarkerDetector", {{"sim", make_image_component<MarkerDetector>}}}}};
}

Expected<Simulation> Simulation::load(const std::filesystem::path& file, Options options) {
    LiveOptions live = simulated_systems(std::move(options.installed));
    live.budget = headless_budget;
    live.build.log = std::move(options.log);
    auto loaded = LiveSystem::load(file, std::move(live));
    if (!loaded) return Unexpected(loaded.error());
    (*loaded)->activate();
    return Simulation(std::move(*loaded));
}

void Simulation::run(double seconds) {
    for (auto left = std::llround(seconds * system().settings().rate); left > 0; --left) tick();
}

}  // namespace nezumi
