// The files of a project that are pushed to a robot.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bindings/push/file_list.hpp"
#include "bindings/push/open_folder.hpp"
#include "engine/base/error.hpp"

namespace nezumi::push {

struct ProjectScan {
    OpenFolder folder;
    FileList list{};
    std::vector<std::string> passed_over{};  ///< FIFOs, devices, sockets: they are not pushed
};

/// All files and folders of the project except those of git, `build/`, editors' copies (`*~`, `*.swp`) and robots' own
/// `*.calibration.lua`. Fails, with the file as its location, if one can't be read.
Expected<ProjectScan> scan_project(const std::filesystem::path& project);

}  // namespace nezumi::push
