// Checks first, then writes. After an error, the files that were already written are removed.
#include "bindings/cli/new/files.hpp"

#include <cerrno>
#include <cstdio>
#include <system_error>

namespace nezumi::cli {
namespace {

namespace fs = std::filesystem;

// Creates the folder and its missing parents, and records them.
std::error_code make_folders(const fs::path& folder, std::vector<fs::path>& made) {
    std::error_code problem;
    if (folder.empty() || fs::is_directory(folder, problem)) return {};
    if (const auto above = make_folders(folder.parent_path(), made)) return above;
    if (fs::create_directory(folder, problem)) made.push_back(folder);
    return problem;
}

// "wx": fails if another program has made the file since the check.
bool write(const NewFile& file) {
    std::FILE* out = std::fopen(file.path.c_str(), "wxb");
    if (out == nullptr) return false;
    const bool written = std::fwrite(file.text.data(), 1, file.text.size(), out) == file.text.size();
    return (std::fclose(out) == 0) && written;
}

}  // namespace

Expected<void> write_new_files(const std::vector<NewFile>& files) {
    for (const NewFile& file : files) {
        std::error_code none;
        if (fs::symlink_status(file.path, none).type() != fs::file_type::not_found &&
            fs::symlink_status(file.path, none).type() != fs::file_type::none) {
            return failure("exists already, and nothing is overwritten: choose another name or move it away",
                           {file.path.string()});
        }
    }
    std::vector<fs::path> made;  // in order of creation
    const auto take_back = [&] {
        std::error_code none;
        for (auto path = made.rbegin(); path != made.rend(); ++path) fs::remove(*path, none);
    };
    for (const NewFile& file : files) {
        std::error_code problem = make_folders(file.path.parent_path(), made);
        if (!problem && !write(file)) {
            problem = std::error_code(errno, std::generic_category());
            if (errno != EEXIST) made.push_back(file.path);
        }
        if (problem) {
            take_back();
            return failure("can't be written: " + problem.message(), {file.path.string()});
        }
        made.push_back(file.path);
    }
    return {};
}

}  // namespace nezumi::cli
