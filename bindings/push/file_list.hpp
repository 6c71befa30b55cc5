// A list of files: names and hashes of contents.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "engine/base/error.hpp"

namespace nezumi::push {

struct ListedFile {
    enum class Kind : unsigned char {
        folder,
        file,
        program,  ///< an executable file
        link,     ///< a symbolic link
        other,    ///< a FIFO, a device, a socket, an unreadable file: found in folders, never in lists
    };
    Kind kind = Kind::file;
    std::string hash{};  ///< SHA-256 of a file's content or of a link's target, as 64 digits; a folder has none

    bool is_folder() const { return kind == Kind::folder; }
    bool operator==(const ListedFile&) const = default;
};

/// True if both have the same content. A file and a program may have the same content.
bool have_same_content(const ListedFile& one, const ListedFile& other);

/// Files and folders within a folder, by their relative paths ("behaviors/drive.lua"). A folder comes before its
/// contents.
using FileList = std::map<std::string, ListedFile>;

/// The push's own folder within a pushed folder: never part of a list.
inline constexpr std::string_view own_folder = ".nezumi-push";

/// The list as text, with a line for each file: `file 9f86d0... "behaviors/drive.lua"`.
std::string to_text(const FileList& list);

/// Reads the text of `to_text`. Fails if it is incomplete, or has a name that leads out of the folder.
Expected<FileList> read_file_list(std::string_view text);

}  // namespace nezumi::push
