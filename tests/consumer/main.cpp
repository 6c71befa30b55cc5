// Somebody else's program: runs the installed tutorial for ten simulated seconds and looks where the mouse got to.
#include <cstdio>
#include <filesystem>

#include "bindings/lua/files/system_file.hpp"
#include "bindings/lua/script/behavior_maker.hpp"
#include "engine/system/build_system.hpp"
#include "sim/world.hpp"

using namespace nezumi;

int main(int, char** arguments) {
    const std::filesystem::path installed = arguments[1];
    const std::filesystem::path file = installed / "behaviors/systems/stop_at_wall.lua";
    const Project project = Project::of(file, {installed});
    const auto spec = read_system_file(file, project);
    if (!spec) return std::puts(describe(spec.error()).c_str()), 1;

    const auto behavior = [&](const BehaviorEntry& entry, const MakerContext& context) {
        return make_behavior(entry, context, {.project = project});
    };
    const auto system = build_system(*spec, {.world = sim::make_world, .behavior = behavior}, {});
    if (!system) return std::puts(describe(system.error()).c_str()), 1;

    activate_all(**system, *spec);
    for (int tick = 0; tick < 1000; ++tick) (*system)->tick();
    const double x = (*system)->world()->truth((*system)->find_robot("mouse")->id()).pose.position.x;
    std::printf("the mouse stopped at %.2f m\n", x);
    return x > 0.4 && x < 0.7 ? 0 : 1;  // the wall begins at 0.75 m
}
