// How a project's files are read: from the disk, or from what a journal keeps of them.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi {

/// What somebody has found at a path, as far as it was asked for.
struct PathSeen {
    std::string what;                               ///< as `ProjectFiles::what_is`
    std::optional<std::string> text;                ///< of a file that was read
    std::string unreadable;                         ///< why it could not be read
    std::optional<std::vector<std::string>> names;  ///< in a folder that was listed

    /// Adds what was found later; of another kind it takes the place of what was there.
    void update(PathSeen later);
};
using FilesSeen = std::map<std::filesystem::path, PathSeen>;

class ProjectFiles {
public:
    virtual ~ProjectFiles() = default;
    /// What relative paths are relative to.
    virtual std::filesystem::path working_folder() const = 0;
    /// "a file", "a folder", or as `other_than_file`; "" where nothing is.
    virtual std::string what_is(const std::filesystem::path& path) const = 0;
    /// Whether there is a plain file. A device or a pipe may never end: what a name stands for is none of these.
    bool is_file(const std::filesystem::path& path) const { return what_is(path) == "a file"; }
    bool is_folder(const std::filesystem::path& path) const { return what_is(path) == "a folder"; }
    /// The names in a folder, sorted, 10000 at most; none where none can be read.
    virtual std::vector<std::string> names_in(const std::filesystem::path& folder) const = 0;
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
    std::string what_is(const std::filesystem::path& path) const override;
    std::vector<std::string> names_in(const std::filesystem::path& folder) const override;
    Expected<std::string> read(const std::filesystem::path& path, const std::string& shown) const override;
    void adopt(const FilesSeen& seen) const override;

    /// What was found since the last time.
    FilesSeen take() { return std::exchange(seen_, {}); }

private:
    const ProjectFiles& files_;
    mutable FilesSeen seen_;
};

}  // namespace nezumi
