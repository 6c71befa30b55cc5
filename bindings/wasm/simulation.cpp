// Combines the rooms of a simulated system without cameras.
#include <fmt/format.h>

#include <utility>

#include "bindings/embed/simulation.hpp"
#include "bindings/lua/reload/lua_host.hpp"
#include "engine/devices/joystick.hpp"
#include "engine/devices/wired_device.hpp"
#include "engine/world/occupancy_map.hpp"
#include "engine/world/ros_calibration.hpp"
#include "sim/world.hpp"

namespace nezumi {
namespace {

Expected<std::unique_ptr<Component>> refuse(const ComponentEntry& entry, System& /*system*/) {
    return failure(fmt::format("component '{}': nezumi in a page has no cameras and no vision, and so no {}",
                               entry.name, entry.type),
                   entry.place);
}

Unexpected no_yaml(const std::string& file) { return failure("nezumi in a page reads no YAML", {file}); }

}  // namespace

LiveOptions simulated_systems(std::vector<std::filesystem::path> installed) {
    LiveOptions live{.scripts = &lua_scripts(),
                     .installed = std::move(installed),
                     .world = sim::make_world,
                     .components = {{"Camera", {{"sim", refuse}}},
                                    {"ColorDetector", {{"sim", refuse}}},
                                    {"Joystick", {{"sim", make_joystick}}},
                                    {"LineDetector", {{"sim", refuse}}},
                                    {"MarkerDetector", {{"sim", refuse}}}}};
    add_simulated_devices(live.components);
    return live;
}

Expected<CameraIntrinsics> read_ros_calibration(std::string_view /*text*/, const std::string& file) {
    return no_yaml(file);
}
Expected<OccupancyFacts> read_occupancy_facts(std::string_view /*text*/, const std::string& file) {
    return no_yaml(file);
}
Expected<OccupancyMap> read_occupancy(const OccupancyFacts& /*facts*/, std::string_view /*picture*/,
                                      const std::string& file, double /*height*/, const Place& /*place*/) {
    return no_yaml(file);
}
std::string describe(const OccupancyMap& /*map*/, const std::string& file) { return file; }

}  // namespace nezumi
