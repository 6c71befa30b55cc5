// The first line has the format's version and the last one the number of files, so an incomplete list is detected.
#include "bindings/push/file_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "engine/base/lua_text.hpp"

namespace nezumi::push {
namespace {

constexpr std::string_view first_line = "nezumi files 1";
constexpr std::array<std::string_view, 4> kinds{"folder", "file", "program", "link"};
constexpr std::size_t hash_digits = 64;

// The name must be within the folder and outside the push's own folder.
bool is_name(std::string_view name) {
    if (name.find('\0') != name.npos) return false;
    bool is_first = true;
    while (true) {
        const auto slash = std::min(name.find('/'), name.size());
        const auto part = name.substr(0, slash);
        if (part.empty() || part == "." || part == ".." || (is_first && part == own_folder)) return false;
        if (slash == name.size()) return true;
        name.remove_prefix(slash + 1);
        is_first = false;
    }
}

bool is_hash(std::string_view hash) {
    return hash.size() == hash_digits && hash.find_first_not_of("0123456789abcdef") == hash.npos;
}

std::string_view take_to(std::string_view& text, char end) {
    const auto at = std::min(text.find(end), text.size());
    const auto taken = text.substr(0, at);
    text.remove_prefix(std::min(at + 1, text.size()));
    return taken;
}

}  // namespace

bool have_same_content(const ListedFile& one, const ListedFile& other) {
    const auto sort = [](const ListedFile& file) {
        return file.kind == ListedFile::Kind::program ? ListedFile::Kind::file : file.kind;
    };
    return one.kind != ListedFile::Kind::other && sort(one) == sort(other) && one.hash == other.hash;
}

std::string to_text(const FileList& list) {
    std::string text = fmt::format("{}\n", first_line);
    for (const auto& [name, file] : list) {
        fmt::format_to(std::back_inserter(text), "{} {} {}\n", kinds.at(static_cast<std::size_t>(file.kind)),
                       file.is_folder() ? "-" : file.hash, lua_quoted(name));
    }
    return text + fmt::format("end {}\n", list.size());
}

Expected<FileList> read_file_list(std::string_view text) {
    FileList list;
    const auto damaged = [] { return failure("is damaged: remove it on the robot, then push again"); };
    if (take_to(text, '\n') != first_line) return damaged();
    while (!text.empty()) {
        std::string_view line = take_to(text, '\n');
        const auto word = take_to(line, ' ');
        if (word == "end")
            return text.empty() && line == std::to_string(list.size()) ? list : Expected<FileList>(damaged());
        const auto* const kind = std::find(kinds.begin(), kinds.end(), word);
        const std::string hash(take_to(line, ' '));
        std::string name = lua_unquoted(line);
        if (kind == kinds.end() || !is_name(name)) return damaged();
        ListedFile file{.kind = static_cast<ListedFile::Kind>(kind - kinds.begin())};
        if (!file.is_folder()) {
            if (!is_hash(hash)) return damaged();
            file.hash = hash;
        }
        if (!list.emplace(std::move(name), std::move(file)).second) return damaged();
    }
    return damaged();
}

}  // namespace nezumi::push
