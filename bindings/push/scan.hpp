// The files of a project that a robot gets.
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
    std::vector<std::string> passed_over{};  ///< FIFOs, devices, sockets
};

/// All files and folders of the project but those of git, of `build/`, editors' copies (`*~`, `*.swp`) and robots' own
/// `*.calibration.lua`. An error, with the file as its place, when one can't be read.
Expected<ProjectScan> scan_project(const std::filesystem::path& project);

}  // namespace nezumi::push
