// The files of a run: kept while it runs, and given back when it is replayed.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <thread>

#include "bindings/lua/project/project_files.hpp"
#include "engine/world/world.hpp"

namespace nezumi {

/// Texts by their whole paths; nothing: a file that was there before and is there no longer.
using FileTexts = std::map<std::string, std::optional<std::string>>;

/// Reads from the disk, and remembers what it has read in the thread that made it: what other threads only try is none
/// of the run's.
class RecordingFiles final : public ProjectFiles {
public:
    std::filesystem::path working_folder() const override { return disk().working_folder(); }
    bool is_file(const std::filesystem::path& path) const override;
    bool is_folder(const std::filesystem::path& path) const override { return disk().is_folder(path); }
    Expected<std::string> read(const std::filesystem::path& path, const std::string& shown) const override;
    void adopt(const FilesSeen& seen) const override;

    /// What was read since the last time.
    FileTexts take();

private:
    void note_missing(const std::filesystem::path& path) const;
    std::string whole(const std::filesystem::path& path) const;

    std::thread::id owner_ = std::this_thread::get_id();
    mutable FileTexts read_;
    std::set<std::string> known_;
};

/// Gives back what was recorded; the disk is not looked at.
class RecordedFiles final : public ProjectFiles {
public:
    explicit RecordedFiles(std::filesystem::path working_folder) : working_folder_(std::move(working_folder)) {}

    std::filesystem::path working_folder() const override { return working_folder_; }
    bool is_file(const std::filesystem::path& path) const override;
    bool is_folder(const std::filesystem::path& path) const override;
    Expected<std::string> read(const std::filesystem::path& path, const std::string& shown) const override;

    /// From now on these are as they are here, the others as they were.
    void update(const FileTexts& texts);
    void clear() { texts_.clear(); }

private:
    std::string whole(const std::filesystem::path& path) const;

    std::filesystem::path working_folder_;
    std::map<std::string, std::string> texts_;
};

/// Worlds whose pictures are read through `files`, which must outlive them.
WorldFactory with_pictures_from(const RecordingFiles& files, WorldFactory make);
WorldFactory with_pictures_from(const RecordedFiles& files, WorldFactory make);

}  // namespace nezumi
