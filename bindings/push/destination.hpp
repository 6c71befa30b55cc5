// The destination of a project on the robot: the folder that the user named, unless the project would mix with other
// files.
#pragma once

#include <filesystem>
#include <string>

#include "bindings/push/file_list.hpp"
#include "engine/base/error.hpp"

namespace nezumi::push {

struct Destination {
    /// The path without links, `.` and `..`. The folder may not exist yet. If it exists, it is empty or was pushed to
    /// before: by this version, so that it contains `.nezumi-push`, or by an older one (`brought_before`).
    std::filesystem::path folder;
    /// If an older version of nezumi, which made no list, pushed to the folder: the pushed files, and the path of its
    /// copy of them.
    FileList brought_before{};
    std::filesystem::path copy_before{};
};

/// Resolves the folder `named` from the working directory; "~" is the home folder. Refuses a home folder, the root
/// folder, a folder above one of these, and a folder with files that was not pushed to before.
Expected<Destination> find_destination(const std::string& named);

}  // namespace nezumi::push
