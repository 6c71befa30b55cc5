// Simulated systems in a web page: without cameras, and without files in YAML.
#include "bindings/embed/simulation.hpp"

#include <utility>

#include "bindings/embed/without_vision.hpp"
#include "engine/world/occupancy_map.hpp"
#include "engine/world/ros_calibration.hpp"
#include "sim/world.hpp"

namespace nezumi {
namespace {

Unexpected no_yaml(const std::string& file) { return failure("nezumi in a web page can't read YAML files", {file}); }

}  // namespace

LiveOptions simulated_systems(std::vector<std::filesystem::path> installed) {
    LiveOptions live = systems_without_vision(std::move(installed), "nezumi in a web page");
    live.world = sim::make_world;
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
