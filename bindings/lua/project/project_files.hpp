// How a project's files are read: from the disk, or from what a journal keeps of them.
#pragma once

#include <filesystem>
#include <string>

#include "engine/base/error.hpp"

namespace nezumi {

class ProjectFiles {
public:
    virtual ~ProjectFiles() = default;
    /// What relative paths are relative to.
    virtual std::filesystem::path working_folder() const = 0;
    /// Whether there is a plain file. A device or a pipe may never end: what a name stands for is none of these.
    virtual bool is_file(const std::filesystem::path& path) const = 0;
    virtual bool is_folder(const std::filesystem::path& path) const = 0;
    /// The whole of a file, as `read_whole`.
    virtual Expected<std::string> read(const std::filesystem::path& path, const std::string& shown) const = 0;
};

/// The disk.
const ProjectFiles& disk();

}  // namespace nezumi
