// The files of a run: kept while it runs, and given back when it is replayed.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "engine/project/project_files.hpp"
#include "engine/world/world.hpp"

namespace nezumi {

/// Reads from the disk, and remembers what it has found in the thread that made it: what other threads only try is none
/// of the run's.
class RecordingFiles final : public ProjectFiles {
public:
    std::filesystem::path working_folder() const override { return disk().working_folder(); }
    std::string what_is(const std::filesystem::path& path) const override;
    std::vector<std::string> names_in(const std::filesystem::path& folder) const override;
    Expected<std::string> read(const std::filesystem::path& path, const std::string& shown) const override;
    void adopt(const FilesSeen& seen) const override { notes_.adopt(seen); }

    /// What was found since the last time, by whole paths; of what is not there only what was there before.
    FilesSeen take();

private:
    const ProjectFiles& here() const;

    std::thread::id owner_ = std::this_thread::get_id();
    NotedFiles notes_{disk()};
    std::set<std::filesystem::path> known_;
};

/// Gives back what was recorded; the disk is not looked at.
class RecordedFiles final : public ProjectFiles {
public:
    explicit RecordedFiles(std::filesystem::path working_folder) : working_folder_(std::move(working_folder)) {}

    std::filesystem::path working_folder() const override { return working_folder_; }
    std::string what_is(const std::filesystem::path& path) const override;
    std::vector<std::string> names_in(const std::filesystem::path& folder) const override;
    Expected<std::string> read(const std::filesystem::path& path, const std::string& shown) const override;

    /// From now on these are as they are here, the others as they were.
    void update(const FilesSeen& seen);
    void clear() { seen_.clear(); }

private:
    const PathSeen* find(const std::filesystem::path& path) const;

    std::filesystem::path working_folder_;
    FilesSeen seen_;
};

/// Worlds whose pictures are read through `files`, which must outlive them.
WorldFactory with_pictures_from(const RecordingFiles& files, WorldFactory make);
WorldFactory with_pictures_from(const RecordedFiles& files, WorldFactory make);

}  // namespace nezumi
