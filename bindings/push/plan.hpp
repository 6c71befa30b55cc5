// Plans what a push changes in the robot's folder, and what it keeps.
#pragma once

#include <string>
#include <vector>

#include "bindings/push/file_list.hpp"
#include "bindings/push/open_folder.hpp"

namespace nezumi::push {

struct FileChange {
    enum class What : unsigned char {
        added,
        changed,
        removed,
        kept_edited,   ///< from an earlier push, edited on the robot since, and different in the project
        kept_own,      ///< not from a push, and the project has another file with this name
        kept_removed,  ///< as kept_edited, but no longer in the project: push no longer manages it
    };
    What what;
    std::string name;

    bool operator==(const FileChange&) const = default;
};

/// True if a file is added, changed or removed on the robot.
bool is_change(FileChange::What what);
/// True if a file of the project is not put on the robot.
bool is_withheld(FileChange::What what);

struct PushPlan {
    std::vector<FileChange> changes{};  ///< sorted by name, without the empty folders that the push removes
    FileList next{};                    ///< the list of pushed files after this push
};

/// `pushed` are the files of earlier pushes, `project` the files to push. `there` is the folder on the robot, or null
/// if it does not exist. A file on the robot that has the project's content counts as pushed.
PushPlan plan_push(const FileList& pushed, const FileList& project, const OpenFolder* there);

}  // namespace nezumi::push
