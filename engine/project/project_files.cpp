// The disk, and notes of what was found.
#include "engine/project/project_files.hpp"

#include <algorithm>
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
    std::string what_is(const fs::path& path) const override {
        std::error_code problem;
        return fs::is_regular_file(path, problem) ? "a file" : std::string(other_than_file(path));
    }
    std::vector<std::string> names_in(const fs::path& folder) const override {
        constexpr std::size_t most = 10'000;
        std::vector<std::string> names;
        std::error_code problem;
        for (fs::directory_iterator entry(folder, problem), end; !problem && entry != end && names.size() < most;
             entry.increment(problem))
            names.push_back(entry->path().filename().string());
        std::sort(names.begin(), names.end());
        return names;
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

void PathSeen::update(PathSeen later) {
    if (what != later.what) {
        *this = std::move(later);
        return;
    }
    if (later.text || !later.unreadable.empty()) {
        text = std::move(later.text);
        unreadable = std::move(later.unreadable);
    }
    if (later.names) names = std::move(later.names);
}

std::string NotedFiles::what_is(const fs::path& path) const {
    std::string what = files_.what_is(path);
    seen_[path].update({.what = what});
    return what;
}

std::vector<std::string> NotedFiles::names_in(const fs::path& folder) const {
    auto names = files_.names_in(folder);
    // One that is empty or gone now may have had names before.
    PathSeen found{.what = names.empty() ? files_.what_is(folder) : "a folder"};
    if (found.what == "a folder") found.names = names;
    seen_[folder].update(std::move(found));
    return names;
}

Expected<std::string> NotedFiles::read(const fs::path& path, const std::string& shown) const {
    auto text = files_.read(path, shown);
    if (text) {
        seen_[path].update({.what = "a file", .text = *text});
    } else if (std::string what = files_.what_is(path); !what.empty()) {
        seen_[path].update({.what = std::move(what), .unreadable = text.error().message});
    }
    return text;
}

void NotedFiles::adopt(const FilesSeen& seen) const {
    for (const auto& [path, found] : seen) seen_[path].update(found);
}

}  // namespace nezumi
