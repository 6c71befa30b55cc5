// The side of a push that has the project.
#pragma once

#include <string>
#include <vector>

#include "bindings/push/connection.hpp"
#include "bindings/push/plan.hpp"
#include "bindings/push/scan.hpp"
#include "engine/base/error.hpp"

namespace nezumi::push {

struct Sent {
    std::vector<FileChange> changes{};  ///< in the order of their names
    std::string folder{};               ///< its whole path there
    bool has_finished = false;          ///< an interrupted push was finished first
    std::string copy_before{};          ///< a folder there that an earlier nezumi needed; "" where there is none
};

/// Brings a project to the `folder` there, whose nezumi runs `receive_project`; with `only_shows` nothing is changed.
/// An error says what the other side can't do, or that the connection broke.
Expected<Sent> send_project(const PushConnection& connection, const ProjectScan& project, const std::string& folder,
                            bool only_shows);

}  // namespace nezumi::push
