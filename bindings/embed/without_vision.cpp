#include "bindings/embed/without_vision.hpp"

#include <fmt/format.h>

#include <utility>

#include "bindings/lua/reload/lua_host.hpp"
#include "engine/devices/joystick.hpp"
#include "engine/devices/wired_device.hpp"

namespace nezumi {

LiveOptions systems_without_vision(std::vector<std::filesystem::path> installed, const std::string& program) {
    LiveOptions live{.scripts = &lua_scripts(),
                     .installed = std::move(installed),
                     .components = {{"Joystick", {{"sim", make_joystick}}}}};
    for (const char* const type : {"Camera", "ColorDetector", "LineDetector", "MarkerDetector"}) {
        live.components[type]["sim"] = [program](const ComponentEntry& entry,
                                                 System& /*system*/) -> Expected<std::unique_ptr<Component>> {
            return failure(fmt::format("component '{}': {} has no cameras and no vision, so the type {} is missing",
                                       entry.name, program, entry.type),
                           entry.place);
        };
    }
    add_simulated_devices(live.components);
    return live;
}

}  // namespace nezumi
