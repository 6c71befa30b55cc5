// Looks for the installed files and joins the rooms.
#include "bindings/cli/environment.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <system_error>

#include "bindings/cli/commands.hpp"
#include "bindings/console/put_text.hpp"
#include "engine/devices/camera.hpp"
#include "engine/devices/joystick.hpp"
#include "engine/vision/marker_detector.hpp"
#include "sim/world.hpp"

namespace nezumi::cli {

std::vector<std::filesystem::path> installed_folders() {
    std::vector<std::filesystem::path> folders;
    std::error_code none;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", none);
    for (const std::filesystem::path& folder :
         {program.parent_path().parent_path() / "share/nezumi", std::filesystem::path(NEZUMI_SOURCE_ROOT)}) {
        if (std::filesystem::is_directory(folder / "engine/robots", none)) folders.push_back(folder);
    }
    return folders;
}

LiveOptions simulated_systems() {
    return {
        .installed = installed_folders(),
        .world = sim::make_world,
        .components = {
            {"Camera", make_simulated_camera}, {"Joystick", make_joystick}, {"MarkerDetector", make_marker_detector}}};
}

int refuse(std::string_view why) {
    put_text(stderr, fmt::format("nezumi: {}\n", why));
    return kCouldNotRun;
}

int refuse(const Error& error) {
    // A place begins the line, so that editors can go there.
    if (error.place.file.empty()) return refuse(error.message);
    put_text(stderr, describe(error) + "\n");
    return kCouldNotRun;
}

}  // namespace nezumi::cli
