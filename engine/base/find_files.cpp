// Searches folder by folder; a folder that can't be read does not affect the others.
#include "engine/base/find_files.hpp"

#include <algorithm>
#include <string>
#include <system_error>

namespace nezumi {
namespace {

namespace fs = std::filesystem;

void add_files_of(const fs::path& folder, std::string_view ending, FoundFiles& found) {
    std::error_code problem;
    std::vector<fs::path> below;
    for (fs::directory_iterator entry(folder, problem), end; !problem && entry != end; entry.increment(problem)) {
        const std::string name = entry->path().filename().string();
        if (name.starts_with(".")) continue;
        std::error_code none;
        if (fs::is_directory(entry->symlink_status(none))) {
            below.push_back(entry->path());
        } else if (name.ends_with(ending) && entry->is_regular_file(none)) {
            found.files.push_back(entry->path().lexically_normal());
        }
    }
    if (problem) found.errors.push_back({"can't be read: " + problem.message(), {folder.lexically_normal().string()}});
    for (const fs::path& each : below) add_files_of(each, ending, found);
}

}  // namespace

FoundFiles find_files(const fs::path& folder, std::string_view ending) {
    FoundFiles found;
    add_files_of(folder, ending, found);
    std::sort(found.files.begin(), found.files.end());
    return found;
}

}  // namespace nezumi
