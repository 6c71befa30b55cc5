// Part by part: a slip in a folder's name does not hide one in the file's.
#include "bindings/lua/project/near_path.hpp"

#include <algorithm>
#include <string_view>
#include <system_error>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_names = 10'000;  // of one folder

std::string nearest_in(const fs::path& folder, const std::string& name) {
    std::vector<std::string> names;
    std::error_code problem;
    for (fs::directory_iterator entry(folder.empty() ? "." : folder, problem), end;
         !problem && entry != end && names.size() < most_names; entry.increment(problem)) {
        std::string found = entry->path().filename().string();
        if (!found.starts_with('.')) names.push_back(std::move(found));
    }
    std::sort(names.begin(), names.end());
    return std::string(nearest(name, {names.begin(), names.end()}));
}

}  // namespace

std::string near_path(const fs::path& path) {
    fs::path there;
    std::error_code none;
    for (const fs::path& part : path) {
        if (fs::exists(fs::symlink_status(there / part, none))) {
            there /= part;
            continue;
        }
        const std::string near = nearest_in(there, part.string());
        if (near.empty()) return "";
        there /= near;
    }
    return there.string();
}

std::string did_you_mean_path(const fs::path& path) {
    const std::string near = near_path(path);
    return near.empty() ? "" : " (did you mean '" + near + "'?)";
}

}  // namespace nezumi
