// Access to the files of a project: on the disk, or in a journal.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi {

/// What was found at a path.
struct PathSeen {
    std::string what;                               ///< the result of `ProjectFiles::what_is`
    std::optional<std::string> text;                ///< content of a file that was read
    std::string unreadable;                         ///< why it could not be read
    std::optional<std::vector<std::string>> names;  ///< names in a folder that was listed

    /// Adds later results; if `what` has changed, replaces everything.
    void update(PathSeen later);
};
using FilesSeen = std::map<std::filesystem::path, PathSeen>;

class ProjectFiles {
public:
    virtual ~ProjectFiles() = default;
    /// The folder for relative paths.
    virtual std::filesystem::path working_folder() const = 0;
    /// "a file", "a folder", or another result of `other_than_file`; "" if there is nothing.
    virtual std::string what_is(const std::filesystem::path& path) const = 0;
    /// Whether the path is a regular file. Not for a device or a pipe: reading one may never end.
    bool is_file(const std::filesystem::path& path) const { return what_is(path) == "a file"; }
    bool is_folder(const std::filesystem::path& path) const { return what_is(path) == "a folder"; }
    /// The names in a folder, sorted, at most 10000; empty if it can't be read.
    virtual std::vector<std::string> names_in(const std::filesystem::path& folder) const = 0;
    /// The content of a file, as `read_whole`.
    virtual Expected<std::string> read(const std::filesystem::path& path, const std::string& shown) const = 0;
};

/// The files on the disk.
const ProjectFiles& disk();

/// The files that an act reads: each is read once, and does not change afterwards. For one thread at a time.
class FileSnapshot final : public ProjectFiles {
public:
    /// `files` must outlive this object. `found` has results of earlier reading, which are used instead of `files`.
    explicit FileSnapshot(const ProjectFiles& files, FilesSeen found = {})
        : files_(files), working_folder_(files.working_folder()), found_(std::move(found)) {}
    std::filesystem::path working_folder() const override { return working_folder_; }
    std::string what_is(const std::filesystem::path& path) const override;
    std::vector<std::string> names_in(const std::filesystem::path& folder) const override;
    Expected<std::string> read(const std::filesystem::path& path, const std::string& shown) const override;

    /// Returns all results by full path, and forgets them.
    FilesSeen take() {
        known_.clear();
        return std::exchange(found_, {});
    }

private:
    PathSeen& at(const std::filesystem::path& path) const;

    const ProjectFiles& files_;
    std::filesystem::path working_folder_;
    mutable FilesSeen found_;
    mutable std::unordered_map<std::string, PathSeen*> known_;  // the same, by the path as the caller wrote it
};

}  // namespace nezumi
