// What is refused here nobody writes.
#include "bindings/console/file_to_write.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

namespace nezumi {

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
    if (auto ok = check_is_within(home, path, path.string(), written.what); !ok) return Unexpected(ok.error());
    return path;
}

}  // namespace nezumi
