// The destination of a project on the robot: a folder given by a person, unless the project would mix with other files.
#pragma once

#include <filesystem>
#include <string>

#include "bindings/push/file_list.hpp"
#include "engine/base/error.hpp"

namespace nezumi::push {

struct Destination {
    /// Without links, `.` and `..`. It may not exist yet. If it exists it is empty, has the push's own folder, or
    /// `brought_before` has files.
    std::filesystem::path folder;
    /// The files pushed by an older nezumi without a list there, and its copy of them.
    FileList brought_before{};
    std::filesystem::path copy_before{};
};

/// Resolves the folder `named` from the working directory; "~" is the home folder. Refuses a home folder, the root
/// folder, a folder above one of these, and a folder with files that was not pushed to before.
Expected<Destination> find_destination(const std::string& named);

}  // namespace nezumi::push
