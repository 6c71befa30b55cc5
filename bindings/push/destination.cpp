// Folders are compared by identity, not by path: links and mounts can give a folder several paths.
#include "bindings/push/destination.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <sstream>
#include <system_error>
#include <vector>

#include "bindings/push/open_folder.hpp"
#include "bindings/push/pushed_folder.hpp"
#include "bindings/push/scan.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi::push {
namespace {

namespace fs = std::filesystem;

// The user's home folder, in which ssh starts.
fs::path home_folder() {
    std::error_code none;
    const char* home = std::getenv("HOME");
    return home != nullptr && *home == '/' ? fs::path(home) : fs::current_path(none);
}

// The home folders of all users in /etc/passwd (getpwent() needs shared libraries, which a static program lacks), and
// the folder in which ssh started.
std::vector<fs::path> home_folders() {
    std::error_code none;
    std::vector<fs::path> homes{home_folder(), fs::current_path(none)};
    std::istringstream users(read_whole("/etc/passwd", "").value_or(""));
    constexpr int home_field = 5;  // "name:x:1000:1000:Full Name:/home/name:/bin/sh"
    for (std::string user; std::getline(users, user);) {
        std::istringstream fields(user);
        std::string field;
        int count = 0;
        while (count <= home_field && std::getline(fields, field, ':')) ++count;
        if (count > home_field && field.starts_with("/")) homes.emplace_back(field);
    }
    return homes;
}

bool is_same_folder(const fs::path& one, const fs::path& other) {
    struct stat a {
    }, b{};
    if (one == other) return true;
    return stat(one.c_str(), &a) == 0 && stat(other.c_str(), &b) == 0 && a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

// Returns "is the root folder", "is a home folder", "contains the home folder X", or "" for another folder.
std::string what_it_is(const fs::path& folder) {
    if (is_same_folder(folder, "/")) return "is the root folder";
    for (const fs::path& named : home_folders()) {
        std::error_code none;
        const fs::path home = fs::weakly_canonical(named, none);
        if (is_same_folder(folder, home)) return "is a home folder";
        for (fs::path above = home.parent_path(); above != above.root_path(); above = above.parent_path()) {
            if (is_same_folder(folder, above)) return fmt::format("contains the home folder {}", shown(home.string()));
        }
    }
    return "";
}

Expected<fs::path> find_folder(const std::string& named) {
    if (named.empty()) return failure("expected a folder, got ''");
    fs::path path = named;
    if (named.front() == '~') {
        if (named.size() > 1 && named[1] != '/')
            return failure(fmt::format("{}: expected / after ~; for a folder with this name write ./{}", shown(named),
                                       shown(named)));
        path = home_folder().string() + named.substr(1);
    }
    std::error_code problem;
    path = fs::weakly_canonical(fs::absolute(path, problem), problem);
    if (problem) return failure(fmt::format("{}: {}", shown(named), problem.message()));
    if (!path.has_filename()) path = path.parent_path();
    return path;
}

}  // namespace

Expected<Destination> find_destination(const std::string& named) {
    auto folder = find_folder(named);
    if (!folder) return Unexpected(folder.error());
    Destination destination{.folder = std::move(*folder)};
    if (const std::string what = what_it_is(destination.folder); !what.empty())
        return failure(
            fmt::format("{} {}: choose a folder for this project only, for example --to robots", shown(named), what));

    struct stat status {};
    if (lstat(destination.folder.c_str(), &status) != 0 && errno == ENOENT) return destination;
    const auto opened = OpenFolder::open(destination.folder);
    if (!opened) return failure(fmt::format("{}: {}", shown(named), opened.error().message));
    const auto names = opened->names_in("");
    if (!names) return failure(fmt::format("{} {}", shown(named), names.error().message));
    const bool has_files =
        std::any_of(names->begin(), names->end(), [](const auto& name) { return name != own_folder; });
    if (!has_files || was_pushed_to(*opened)) return destination;

    const fs::path copy = destination.folder.string() + ".coming";
    if (std::error_code none; fs::is_directory(copy, none)) {
        auto files = scan_project(copy);
        if (!files) return Unexpected(files.error());
        destination.brought_before = std::move(files->list);
        destination.copy_before = copy;
        return destination;
    }
    return failure(fmt::format(
        "{} has files and was not pushed to before: choose another folder with --to, or move it away on the robot",
        shown(named)));
}

}  // namespace nezumi::push
