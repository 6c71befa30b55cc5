// The sending side of a push.
#pragma once

#include <string>
#include <vector>

#include "bindings/push/connection.hpp"
#include "bindings/push/plan.hpp"
#include "bindings/push/scan.hpp"
#include "engine/base/error.hpp"

namespace nezumi::push {

struct Sent {
    std::vector<FileChange> changes{};  ///< sorted by name
    std::string folder{};               ///< full path of the folder on the other computer
    bool has_finished = false;          ///< true if an interrupted push was finished first
    std::string copy_before{};  ///< a folder on the other computer that only older versions of nezumi use; "" if none
};

/// Pushes a project to `folder` on the other computer, where nezumi runs `receive_project`. With `only_shows` nothing
/// is changed. An error is that of the other side, or a broken connection.
Expected<Sent> send_project(const PushConnection& connection, const ProjectScan& project, const std::string& folder,
                            bool only_shows);

}  // namespace nezumi::push
