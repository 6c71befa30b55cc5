// The disk, and notes of what was found.
#include "bindings/lua/project/project_files.hpp"

#include <system_error>

#include "engine/base/whole_file.hpp"

namespace nezumi {
namespace fs = std::filesystem;
namespace {

class Disk final : public ProjectFiles {
public:
    fs::path working_folder() const override {
        std::error_code problem;
        return fs::current_path(problem);
    }
    bool is_file(const fs::path& path) const override {
        std::error_code problem;
        return fs::is_regular_file(path, problem);
    }
    bool is_folder(const fs::path& path) const override {
        std::error_code problem;
        return fs::is_directory(path, problem);
    }
    Expected<std::string> read(const fs::path& path, const std::string& shown) const override {
        return read_whole(path, shown);
    }
};

}  // namespace

const ProjectFiles& disk() {
    static const Disk the_disk;
    return the_disk;
}

bool NotedFiles::is_file(const fs::path& path) const {
    const bool is = files_.is_file(path);
    if (!is) seen_.missing.push_back(path);
    return is;
}

Expected<std::string> NotedFiles::read(const fs::path& path, const std::string& shown) const {
    auto text = files_.read(path, shown);
    if (text) seen_.texts.insert_or_assign(path, *text);
    return text;
}

}  // namespace nezumi
