// What a push changes in the robot's folder, and what it leaves as it is there.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bindings/push/file_list.hpp"
#include "bindings/push/open_folder.hpp"

namespace nezumi::push {

struct FileChange {
    enum class What : unsigned char {
        added,
        changed,
        removed,
        kept_edited,   ///< an earlier push brought it, it was edited there since, and is another in the project
        kept_own,      ///< no push has brought it, and the project has another file of this name
        kept_removed,  ///< as kept_edited, but the project has it no longer: from now on it is the robot's own
    };
    What what;
    std::string name;

    bool operator==(const FileChange&) const = default;
};

/// Whether a file there becomes another, or goes.
bool is_change(FileChange::What what);
/// Whether the project has a file that the robot did not get.
bool is_withheld(FileChange::What what);

struct PushPlan {
    std::vector<FileChange> changes{};  ///< in the order of their names; not told: folders that are removed empty
    FileList next{};                    ///< what pushes will have brought when this one is done
};

/// `pushed` is what earlier pushes brought, `project` what there is to bring, `there` the robot's folder; null: there
/// is none yet. A file there with the project's content counts as brought.
PushPlan plan_push(const FileList& pushed, const FileList& project, const OpenFolder* there);

}  // namespace nezumi::push
