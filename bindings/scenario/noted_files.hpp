// The files of a project. Records which files were looked for.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "engine/project/project_files.hpp"

namespace nezumi {

class NotedFiles final : public ProjectFiles {
public:
    /// `files` must outlive this object; null stands for the disk.
    explicit NotedFiles(const ProjectFiles* files) : files_(files != nullptr ? *files : disk()) {}

    std::filesystem::path working_folder() const override { return files_.working_folder(); }
    std::string what_is(const std::filesystem::path& path) const override {
        std::string what = files_.what_is(path);
        if (what.empty()) note(path);
        return what;
    }
    std::vector<std::string> names_in(const std::filesystem::path& folder) const override {
        return files_.names_in(folder);
    }
    Expected<std::string> read(const std::filesystem::path& path, const std::string& shown) const override {
        note(path);
        return files_.read(path, shown);
    }

    /// The files that were read or could not be read, and the places that were empty: if one of them changes, the
    /// result may be another.
    const std::set<std::string>& looked_for() const { return looked_for_; }

private:
    void note(const std::filesystem::path& path) const {
        looked_for_.insert((working_folder() / path).lexically_normal().string());
    }

    const ProjectFiles& files_;
    mutable std::set<std::string> looked_for_{};
};

}  // namespace nezumi
