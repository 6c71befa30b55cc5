// The files of a project, with an additional file that exists only in memory.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "engine/project/project_files.hpp"

namespace nezumi {

class FilesWithText final : public ProjectFiles {
public:
    /// `path` is a full path; `files` must outlive this object.
    FilesWithText(const ProjectFiles& files, std::filesystem::path path, std::string text)
        : files_(files), path_(std::move(path)), text_(std::move(text)) {}

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path working_folder() const override { return files_.working_folder(); }
    std::string what_is(const std::filesystem::path& path) const override {
        return is_it(path) ? "a file" : files_.what_is(path);
    }
    std::vector<std::string> names_in(const std::filesystem::path& folder) const override {
        return files_.names_in(folder);
    }
    Expected<std::string> read(const std::filesystem::path& path, const std::string& shown) const override {
        return is_it(path) ? Expected<std::string>(text_) : files_.read(path, shown);
    }

private:
    bool is_it(const std::filesystem::path& path) const {
        return (path.is_absolute() ? path : working_folder() / path).lexically_normal() == path_;
    }

    const ProjectFiles& files_;
    std::filesystem::path path_;
    std::string text_;
};

}  // namespace nezumi
