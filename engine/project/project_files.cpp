// Reads the disk, and makes snapshots of what was read.
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

PathSeen& FileSnapshot::at(const fs::path& path) const {
    PathSeen*& known = known_[path.native()];
    if (known == nullptr) {
        const auto [seen, is_new] = found_.try_emplace((working_folder_ / path).lexically_normal());
        if (is_new) seen->second.what = files_.what_is(path);
        known = &seen->second;
    }
    return *known;
}

std::string FileSnapshot::what_is(const fs::path& path) const { return at(path).what; }

std::vector<std::string> FileSnapshot::names_in(const fs::path& folder) const {
    PathSeen& seen = at(folder);
    if (seen.what != "a folder") return {};
    if (!seen.names) seen.names = files_.names_in(folder);
    return *seen.names;
}

Expected<std::string> FileSnapshot::read(const fs::path& path, const std::string& shown) const {
    PathSeen& seen = at(path);
    if (!seen.text && seen.unreadable.empty()) {
        auto text = files_.read(path, shown);
        if (text) {
            seen.update({.what = "a file", .text = std::move(*text)});
        } else {
            seen.unreadable = text.error().message;
        }
    }
    if (!seen.text) return failure(seen.unreadable, {shown});
    return *seen.text;
}

}  // namespace nezumi
