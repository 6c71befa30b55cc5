// How a project's files are read: from the disk, or from what a journal keeps of them.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi {

/// What somebody has found of files.
struct FilesSeen {
    std::map<std::filesystem::path, std::string> texts;
    std::vector<std::filesystem::path> missing;  ///< that were looked for
};

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
    /// Counts what another thread has found for the run as found here and now.
    virtual void adopt(const FilesSeen& /*seen*/) const {}
};

/// The disk.
const ProjectFiles& disk();

/// Others, and what was found in them: for a thread that reads for another. For one thread.
class NotedFiles final : public ProjectFiles {
public:
    /// `files` must outlive it.
    explicit NotedFiles(const ProjectFiles& files) : files_(files) {}
    std::filesystem::path working_folder() const override { return files_.working_folder(); }
    bool is_file(const std::filesystem::path& path) const override;
    bool is_folder(const std::filesystem::path& path) const override { return files_.is_folder(path); }
    Expected<std::string> read(const std::filesystem::path& path, const std::string& shown) const override;

    /// What was found since the last time.
    FilesSeen take() { return std::exchange(seen_, {}); }

private:
    const ProjectFiles& files_;
    mutable FilesSeen seen_;
};

}  // namespace nezumi
