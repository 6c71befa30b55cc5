// Files that can't be read count as missing, so a user with few permissions still gets the other results.
#include "hw/doctor/machine_queries.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "engine/base/number_in.hpp"

namespace nezumi::hw {

namespace fs = std::filesystem;

namespace {

// Reads /etc/group. getgrgid would load the computer's name services, which a static program can't do.
std::string name_of_group(gid_t id) {
    std::ifstream groups("/etc/group");
    for (std::string line; std::getline(groups, line);) {
        std::istringstream fields(line);
        std::string name, password, number;
        std::getline(std::getline(std::getline(fields, name, ':'), password, ':'), number, ':');
        if (number == fmt::to_string(id)) return name;
    }
    return "";
}

// Returns 0 if unknown.
int parent_of(const std::string& folder) {
    std::ifstream status(folder + "/status");
    for (std::string line; std::getline(status, line);) {
        if (line.starts_with("PPid:")) return std::atoi(line.c_str() + std::string_view("PPid:").size());
    }
    return 0;
}

}  // namespace

std::string first_line(const std::string& path) {
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    // Texts in a device tree end with a zero byte.
    while (!line.empty() && (line.back() == '\0' || line.back() == ' ' || line.back() == '\r')) line.pop_back();
    return line;
}

std::vector<std::string> names_in(const std::string& folder) {
    std::vector<std::string> names;
    std::error_code error;
    fs::directory_iterator entries(folder, error);
    for (; !error && entries != fs::directory_iterator(); entries.increment(error))
        names.push_back(entries->path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

int opening_fails_with(const std::string& path, Node::Access access) {
    return in_time([path, access] {
               const auto opened = Node(path, access).open();
               return opened ? 0 : opened.error().code;
           })
        .value_or(ETIMEDOUT);
}

tl::expected<std::string, int> ask(const std::string& path) {
    using Answer = tl::expected<std::string, int>;
    return in_time([path]() -> Answer {
               Node node(path, Node::Access::read);
               const auto said = node.read();
               if (!said) return tl::unexpected(said.error().code);
               return std::string(*said);
           })
        .value_or(Answer(tl::unexpect, ETIMEDOUT));
}

std::vector<Holder> holders_of(const std::vector<std::string>& files, const std::string& proc) {
    std::error_code none;
    std::vector<std::string> paths;
    paths.reserve(files.size());
    for (const std::string& file : files) paths.push_back(fs::weakly_canonical(file, none).string());
    std::vector<Holder> holders;
    std::map<int, int> parents;  // by process
    for (const std::string& name : names_in(proc)) {
        const auto process = number_in<int>(name);
        if (!process || *process == getpid()) continue;
        Holder holder{.process = *process};
        const std::string folder = fmt::format("{}/{}", proc, name);
        std::vector<bool> is_open(files.size());
        for (const std::string& file : names_in(folder + "/fd")) {
            const fs::path target = fs::read_symlink(fmt::format("{}/fd/{}", folder, file), none);
            const auto found = std::find(paths.begin(), paths.end(), target.string());
            if (!none && found != paths.end()) is_open[static_cast<std::size_t>(found - paths.begin())] = true;
        }
        for (std::size_t i = 0; i < files.size(); ++i) {
            if (is_open[i]) holder.files.push_back(files[i]);
        }
        if (holder.files.empty()) continue;
        holder.name = first_line(folder + "/comm");
        parents[holder.process] = parent_of(folder);
        holders.push_back(std::move(holder));
    }
    std::erase_if(holders, [&](const Holder& each) { return parents.contains(parents[each.process]); });
    return holders;
}

std::string group_that_may(const std::string& path) {
    struct stat status {};
    if (stat(path.c_str(), &status) != 0 || (status.st_mode & S_IRGRP) == 0 || (status.st_mode & S_IWGRP) == 0 ||
        status.st_gid == 0)
        return "";
    const std::string group = name_of_group(status.st_gid);
    return group.empty() ? "" : fmt::format("sudo adduser $USER {}, then log in again", group);
}

std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i)
        text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
    return text;
}

}  // namespace nezumi::hw
