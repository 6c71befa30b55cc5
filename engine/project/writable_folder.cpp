// Compares paths after resolving links, which may lead out of the project.
#include "engine/project/writable_folder.hpp"

#include <fmt/format.h>

#include <system_error>

namespace nezumi {

std::filesystem::path writable_folder(const Project& project, const std::string& file) {
    if (!project.root().empty()) return project.root();
    return (project.files().working_folder() / file).parent_path();
}

Expected<void> check_is_within(const std::filesystem::path& home, const std::filesystem::path& path,
                               const std::string& shown, std::string_view what) {
    std::error_code problem;
    const auto whole = std::filesystem::absolute(path, problem);
    if (problem) return failure(fmt::format("'{}': the working folder is not known: {}", shown, problem.message()));
    const auto real = std::filesystem::weakly_canonical(whole, problem);
    const auto within = std::filesystem::weakly_canonical(home, problem);
    const auto inside = real.lexically_relative(within);
    if (!problem && !inside.empty() && *inside.begin() != "..") return {};
    return failure(
        fmt::format("'{}' lies outside of the project: {} must be saved in {} or below", shown, what, within.string()));
}

}  // namespace nezumi
