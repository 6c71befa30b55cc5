// The files of a run for its replay.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "engine/project/project_files.hpp"
#include "engine/world/world.hpp"

namespace nezumi {

/// Returns recorded contents without reading the disk.
class RecordedFiles final : public ProjectFiles {
public:
    explicit RecordedFiles(std::filesystem::path working_folder) : working_folder_(std::move(working_folder)) {}

    std::filesystem::path working_folder() const override { return working_folder_; }
    std::string what_is(const std::filesystem::path& path) const override;
    std::vector<std::string> names_in(const std::filesystem::path& folder) const override;
    Expected<std::string> read(const std::filesystem::path& path, const std::string& shown) const override;

    /// Replaces the contents of these files; others are unchanged.
    void update(const FilesSeen& seen);
    void clear() { seen_.clear(); }

private:
    const PathSeen* find(const std::filesystem::path& path) const;

    std::filesystem::path working_folder_;
    FilesSeen seen_;
};

/// A factory of worlds whose pictures are read through `files`, which must outlive the factory. Empty if `make` is
/// empty.
WorldFactory with_pictures_from(const ProjectFiles& files, WorldFactory make);

}  // namespace nezumi
