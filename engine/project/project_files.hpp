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

/// What was found at a path, as far as it was asked for.
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
};

/// The disk.
const ProjectFiles& disk();

/// What an act finds of files: each is looked at and read once, and stays what it was then. For one thread at a time.
class FileSnapshot final : public ProjectFiles {
public:
    /// `files` must outlive it. What was `found` in them before stays as it was.
    explicit FileSnapshot(const ProjectFiles& files, FilesSeen found = {})
        : files_(files), working_folder_(files.working_folder()), found_(std::move(found)) {}
    std::filesystem::path working_folder() const override { return working_folder_; }
    std::string what_is(const std::filesystem::path& path) const override;
    std::vector<std::string> names_in(const std::filesystem::path& folder) const override;
    Expected<std::string> read(const std::filesystem::path& path, const std::string& shown) const override;

    /// All that was found, by whole paths; nothing is kept.
    FilesSeen take() { return std::exchange(found_, {}); }

private:
    PathSeen& at(const std::filesystem::path& path) const;

    const ProjectFiles& files_;
    std::filesystem::path working_folder_;
    mutable FilesSeen found_;
};

}  // namespace nezumi
