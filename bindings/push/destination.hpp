// Where on the robot a project goes: a folder that a person named, unless that would mix it with other files.
#pragma once

#include <filesystem>
#include <string>

#include "bindings/push/file_list.hpp"
#include "engine/base/error.hpp"

namespace nezumi::push {

struct Destination {
    /// Without links, `.` and `..`. It may not exist yet; else it is empty, or has the push's own folder, or
    /// `brought_before` has files.
    std::filesystem::path folder;
    /// What a push by a nezumi that kept no list there yet has brought, and its copy of these files.
    FileList brought_before{};
    std::filesystem::path copy_before{};
};

/// The folder that `named` means, from the working directory; "~" is the home folder. Refused are a home folder, the
/// root folder, a folder above one of these, and one that has files and was not pushed to before.
Expected<Destination> find_destination(const std::string& named);

}  // namespace nezumi::push
