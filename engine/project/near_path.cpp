// Compares part by part, so a misspelt folder does not hide a misspelt file.
#include "engine/project/near_path.hpp"

#include "engine/base/error.hpp"
#include "engine/project/project_files.hpp"

namespace nezumi {
namespace {

namespace fs = std::filesystem;

std::string nearest_in(const fs::path& folder, const std::string& name) {
    auto names = disk().names_in(folder.empty() ? "." : folder);
    std::erase_if(names, [](const std::string& found) { return found.starts_with('.'); });
    return std::string(nearest(name, {names.begin(), names.end()}));
}

}  // namespace

std::string near_path(const fs::path& path) {
    fs::path there;
    for (const fs::path& part : path) {
        if (!disk().what_is(there / part).empty()) {
            there /= part;
            continue;
        }
        const std::string near = nearest_in(there, part.string());
        if (near.empty() || near == part) return "";  // it is a link without a target
        there /= near;
    }
    return there.string();
}

std::string did_you_mean_path(const fs::path& path) {
    const std::string near = near_path(path);
    return near.empty() ? "" : " (did you mean '" + near + "'?)";
}

}  // namespace nezumi
