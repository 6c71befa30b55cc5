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

/// Reads a regular file completely, and never waits. An error for a FIFO, a device, a socket or a folder, and for a
/// file that does not exist, can't be read, or has more than `largest` bytes. The error's location is `shown`.
Expected<std::string> read_whole(const std::filesystem::path& file, const std::string& shown,
                                 std::size_t largest = largest_text);

/// What is at a path, if it is not a regular file: "a folder", "a FIFO", "a socket" or "a device". "" for a regular
/// file, or if there is nothing.
std::string_view other_than_file(const std::filesystem::path& path);

/// Writes a text completely to an open file, with as many calls as needed. Returns 0, or the errno of the failed call.
int write_all(int file, std::string_view text);

/// Opens a file for writing, and creates it if necessary. A pipe without a reader is an error. The error says why the
/// file can't be written, and its location is the file.
Expected<int> open_to_write(const std::filesystem::path& file);

/// Writes `text` beside `file`, and replaces `file` when it is complete (`StagedFile`): after an error the old file is
/// unchanged, and nothing else is left. Follows a link; writes a device or a pipe directly. If `kept` is not
/// empty, the old file is kept under this name. The error's location is the file.
Expected<void> write_whole(const std::filesystem::path& file, std::string_view text, const std::string& kept = {});

}  // namespace nezumi
