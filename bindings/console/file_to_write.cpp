// Accepts regular files only: writing to another kind of file could block.
#include "bindings/console/file_to_write.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/list.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi {

Expected<std::filesystem::path> file_to_write(const std::filesystem::path& home, const std::string& name,
                                              const WrittenFile& written) {
    const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
    if (std::any_of(name.begin(), name.end(), is_control))
        return failure(fmt::format("'{}' is not a file name: it contains a control character", shown(name)));
    std::filesystem::path path = name;
    if (path.filename().empty()) return failure(fmt::format("'{}' is not a file name", name));
    if (!path.has_extension()) path += written.endings.front();
    if (const auto what = other_than_file(path); !what.empty())
        return failure(fmt::format("'{}' is {}: give another name", path.string(), what));
    const auto& endings = written.endings;
    if (!contains(endings, path.extension().string())) {
        return failure(fmt::format("the name of {} must end in {}: write {} \"{}\"", written.file,
                                   fmt::join(endings, " or "), written.word,
                                   std::filesystem::path(name).replace_extension(endings.front()).string()));
    }
    if (auto ok = check_is_within(home, path, path.string(), written.what); !ok) return Unexpected(ok.error());
    return path;
}

}  // namespace nezumi
