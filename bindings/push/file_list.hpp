// A list of files: their names and what is in them.
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
        program,  ///< a file that may be executed
        link,     ///< a symbolic one
        other,    ///< a FIFO, a device, a socket, a file that can't be read: found in folders, never in lists
    };
    Kind kind = Kind::file;
    std::string hash{};  ///< SHA-256 of a file's content, of a link's target, as 64 digits; a folder has none

    bool is_folder() const { return kind == Kind::folder; }
    bool operator==(const ListedFile&) const = default;
};

/// Whether both have the same content. A file and a program that differ in nothing else do.
bool have_same_content(const ListedFile& one, const ListedFile& other);

/// Files and folders below one folder, by their names from there ("behaviors/drive.lua"). A folder comes before what is
/// in it.
using FileList = std::map<std::string, ListedFile>;

/// The folder, in a folder that projects are pushed to, which is the push's own: never part of a list.
inline constexpr std::string_view own_folder = ".nezumi-push";

/// A line for each: `file 9f86d0... "behaviors/drive.lua"`.
std::string to_text(const FileList& list);

/// Reads what `to_text` has written. An error where it is not whole, or has a name that leads out of the folder.
Expected<FileList> read_file_list(std::string_view text);

}  // namespace nezumi::push
