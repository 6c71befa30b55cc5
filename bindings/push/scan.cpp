// Reads folder by folder, in order.
#include "bindings/push/scan.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <string_view>

namespace nezumi::push {
namespace {

bool stays(std::string_view name, bool is_in_root) {
    return name == ".git" || name.ends_with(".calibration.lua") || name.ends_with("~") || name.ends_with(".swp") ||
           (is_in_root && (name == "build" || name == own_folder));
}

Expected<void> add_folder(const std::string& folder, ProjectScan& scan) {
    auto names = scan.folder.names_in(folder);
    if (!names) return Unexpected(names.error());
    for (const std::string& last : *names) {
        if (stays(last, folder.empty())) continue;
        const std::string name = folder.empty() ? last : fmt::format("{}/{}", folder, last);
        const auto found = scan.folder.find(name);
        if (!found) continue;  // it was removed meanwhile
        if (found->kind == ListedFile::Kind::other) {
            struct stat status {};
            if (fstatat(scan.folder.descriptor(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0 &&
                S_ISREG(status.st_mode))
                return failure("can't be read", {.file = name});
            scan.passed_over.push_back(name);
            continue;
        }
        scan.list.emplace(name, *found);
        if (!found->is_folder()) continue;
        if (auto added = add_folder(name, scan); !added) return added;
    }
    return {};
}

}  // namespace

Expected<ProjectScan> scan_project(const std::filesystem::path& project) {
    auto folder = OpenFolder::open(project);
    if (!folder) return Unexpected(folder.error());
    ProjectScan scan{.folder = std::move(*folder)};
    if (auto added = add_folder("", scan); !added) return Unexpected(added.error());
    return scan;
}

}  // namespace nezumi::push
