// Files that are read and written whole or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "engine/base/error.hpp"

namespace nezumi {

/// What text that a person wrote has at most [bytes].
inline constexpr std::size_t largest_text = std::size_t{16} << 20;

/// The whole of a regular file. It waits for nobody: a FIFO, a device, a socket or a folder is refused with what it is,
/// as is a file that is not there, may not be read, or has more than `largest` bytes. The error's place is `shown`.
Expected<std::string> read_whole(const std::filesystem::path& file, const std::string& shown,
                                 std::size_t largest = largest_text);

/// "a folder", "a FIFO", "a socket", "a device": what is there and is no regular file; "" for a file, or nothing.
std::string_view other_than_file(const std::filesystem::path& path);

/// Writes all of it to an open file, however many calls that takes. Returns 0, or the errno of the one that failed.
int write_all(int file, std::string_view text);

/// Opens a file to be written, and makes it where there is none. A pipe that nobody reads is an error, not waited for.
/// The error says why it can't be written, with the file as its place.
Expected<int> open_to_write(const std::filesystem::path& file);

/// Writes `text` beside `file` and puts it in its place when all of it is there (`StagedFile`): whatever goes wrong,
/// what was there before is still there, and nothing else. A link is followed; a device or a pipe is written as it is.
/// With `kept`, what was there goes on under that name. The error says why not, with the file as its place.
Expected<void> write_whole(const std::filesystem::path& file, std::string_view text, const std::string& kept = {});

}  // namespace nezumi
