// Replaces simulation and vision in a program without them (NEZUMI_SIMULATION=OFF) by error messages.
#include <fmt/format.h>

#include <utility>

#include "bindings/embed/simulation.hpp"
#include "bindings/lua/reload/lua_host.hpp"
#include "engine/devices/joystick.hpp"
#include "engine/devices/wired_device.hpp"

namespace nezumi {
namespace {

Expected<std::unique_ptr<Component>> refuse(const ComponentEntry& entry, System& /*system*/) {
    return failure(fmt::format("component '{}': this build of nezumi has no cameras and no vision, and no {}",
                               entry.name, entry.type),
                   entry.place);
}

}  // namespace

LiveOptions simulated_systems(std::vector<std::filesystem::path> installed) {
    LiveOptions live{.scripts = &lua_scripts(),
                     .installed = std::move(installed),
                     .components = {{"Camera", {{"sim", refuse}}},
                                    {"ColorDetector", {{"sim", refuse}}},
                                    {"Joystick", {{"sim", make_joystick}}},
                                    {"LineDetector", {{"sim", refuse}}},
                                    {"MarkerDetector", {{"sim", refuse}}}}};
    add_simulated_devices(live.components);
    return live;
}

void keep_sounds(LiveOptions& /*live*/, const std::string& /*folder*/) {}

}  // namespace nezumi
