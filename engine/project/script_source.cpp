// Reads script files, and derives type names from their names.
#include "engine/project/script_source.hpp"

#include <cctype>
#include <set>
#include <utility>

#include "engine/ports/payload.hpp"
#include "engine/project/project.hpp"

namespace nezumi {
namespace {

std::string_view file_name(std::string_view path) { return path.substr(path.find_last_of('/') + 1); }

}  // namespace

ScriptFile::ScriptFile(const SourceText& source)
    : path(source.path), shown(source.shown), hash(mix(0, std::string_view(source.text))) {}

Expected<SourceText> read_source(const std::string& path) {
    std::string shown(file_name(path));
    auto text = disk().read(path, shown);
    if (!text) return Unexpected(text.error());
    return SourceText{path, std::move(shown), std::move(*text)};
}

std::vector<std::string> changed_files(const std::vector<ScriptFile>& files,
                                       const std::function<Expected<SourceText>(const std::string& path)>& read) {
    std::set<std::string> seen;
    std::vector<std::string> paths;
    for (const ScriptFile& file : files) {
        if (!seen.insert(file.path).second) continue;
        const auto now = read(file.path);
        if (!now || ScriptFile(*now).hash != file.hash) paths.push_back(file.path);
    }
    return paths;
}

std::string type_of_file(std::string_view path) {
    std::string_view name = file_name(path);
    if (name.ends_with(".lua")) name.remove_suffix(4);
    std::string type;
    bool starts_word = true;
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        const bool is_of_other_script = byte >= 0x80;  // as in a Japanese name
        if (std::isalnum(byte) == 0 && !is_of_other_script) {
            starts_word = true;
            continue;
        }
        type += starts_word ? static_cast<char>(std::toupper(byte)) : c;
        starts_word = false;
    }
    return type;
}

}  // namespace nezumi
