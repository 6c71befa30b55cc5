// Replaces simulation and vision in a program without them (NEZUMI_SIMULATION=OFF) by error messages.
#include <utility>

#include "bindings/embed/simulation.hpp"
#include "bindings/embed/without_vision.hpp"

namespace nezumi {

LiveOptions simulated_systems(std::vector<std::filesystem::path> installed) {
    return systems_without_vision(std::move(installed), "this build of nezumi");
}

void keep_sounds(LiveOptions& /*live*/, const std::string& /*folder*/) {}

}  // namespace nezumi
