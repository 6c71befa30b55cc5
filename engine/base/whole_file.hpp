// Reads and writes files completely or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "engine/base/error.hpp"

namespace nezumi {

/// The largest size of a text that a person wrote [bytes].
inline constexpr std::size_t largest_text = std::size_t{16} << 20;

/// The content of a regular file. It never waits: a FIFO, a device, a socket or a folder is refused, and so is a file
/// that does not exist, can't be read, or has more than `largest` bytes. The error's location is `shown`.
Expected<std::string> read_whole(const std::filesystem::path& file, const std::string& shown,
                                 std::size_t largest = largest_text);

/// "a folder", "a FIFO", "a socket", "a device": an existing object that is not a regular file; "" for a file, or if
/// there is nothing.
std::string_view other_than_file(const std::filesystem::path& path);

/// Writes a text completely to an open file, with as many calls as needed. Returns 0, or the errno of the failed call.
int write_all(int file, std::string_view text);

/// Opens a file for writing, and creates it if necessary. A pipe without a reader is an error. The error says why it
/// can't be written, with the file as its location.
Expected<int> open_to_write(const std::filesystem::path& file);

/// Writes `text` beside `file`, and replaces `file` when it is complete (`StagedFile`): after an error the old file is
/// unchanged, and nothing else is left. Follows a link; writes a device or a pipe directly. With `kept`, the old file
/// gets this name. The error has the file as its location.
Expected<void> write_whole(const std::filesystem::path& file, std::string_view text, const std::string& kept = {});

}  // namespace nezumi
