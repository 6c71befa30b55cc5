// What is refused here nobody writes.
#include "bindings/console/file_to_write.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

namespace nezumi {

std::filesystem::path writable_folder(const Project& project, const std::string& system_file) {
    if (!project.root().empty()) return project.root();
    return std::filesystem::absolute(system_file).parent_path();
}

Expected<std::filesystem::path> file_to_write(const std::filesystem::path& home, const std::string& name,
                                              const WrittenFile& written) {
    const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
    if (std::any_of(name.begin(), name.end(), is_control))
        return failure(fmt::format("'{}' names no file: there is a control character in it", shown(name)));
    std::filesystem::path path = name;
    if (path.filename().empty()) return failure(fmt::format("'{}' names no file", name));
    if (!path.has_extension()) path += written.endings.front();
    std::error_code problem;
    if (std::filesystem::is_directory(path, problem)) return failure(fmt::format("'{}' is a folder", path.string()));
    const auto& endings = written.endings;
    if (std::find(endings.begin(), endings.end(), path.extension().string()) == endings.end()) {
        return failure(fmt::format("{} ends in {}: write {} \"{}\"", written.file, fmt::join(endings, " or "),
                                   written.word,
                                   std::filesystem::path(name).replace_extension(endings.front()).string()));
    }
    // Links may lead out of the project.
    const auto real = std::filesystem::weakly_canonical(std::filesystem::absolute(path), problem);
    const auto within = std::filesystem::weakly_canonical(home, problem);
    const auto inside = real.lexically_relative(within);
    if (problem || inside.empty() || *inside.begin() == "..") {
        return failure(fmt::format("'{}' lies outside of the project: {} is saved in {} or below", path.string(),
                                   written.what, within.string()));
    }
    return path;
}

}  // namespace nezumi
