// A program of another project: runs the installed tutorial for ten simulated seconds and looks where the mouse got to.
#include <nezumi/nezumi.hpp>

#include <cstdio>

int main() {
    auto simulation = nezumi::Simulation::load(NEZUMI_DATA_DIR "/behaviors/systems/stop_at_wall.lua",
                                               {.installed = {NEZUMI_DATA_DIR}, .log = {}});
    if (!simulation) return std::puts(describe(simulation.error()).c_str()), 1;
    simulation->run(10);

    const nezumi::System& system = simulation->system();
    const double x = system.world()->truth(system.find_robot("mouse")->id()).pose.position.x;
    std::printf("after %.2f s the mouse stands at %.2f m\n", simulation->now(), x);
    return x > 0.4 && x < 0.7 ? 0 : 1;  // the wall begins at 0.75 m
}
