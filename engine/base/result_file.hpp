// A file that a run writes step by step. An older file with the same name is kept until the new one is complete.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "engine/base/error.hpp"

namespace nezumi {

/// An existing file is first renamed to "FILE~" (or "FILE~2", ..., if that exists). Devices and pipes are written
/// directly.
class ResultFile {
public:
    /// Returns an error with the reason if the file can't be written, for example a pipe without a reader. The file is
    /// then unchanged.
    static Expected<ResultFile> open(const std::string& file);

    /// Open for writing, empty. The caller must close it.
    int descriptor() const { return descriptor_; }
    /// The path of the file, with links resolved. Empty for a device or a pipe, which can't be read again or removed.
    const std::string& path() const { return path_; }
    /// The path of the older file; empty if there was none.
    const std::string& set_aside() const { return set_aside_; }
    /// ", and the previous file is now FILE~": an addition to the message that the new file is not complete; "" if
    /// there was no older file.
    std::string told_of_older() const;

    // Call these functions after the descriptor is closed.

    /// Removes the older file. Call it when the new file is complete.
    void replace_older();
    /// Removes the new file. The older file gets its name back.
    void discard();
    /// Cuts the new file after its last complete row, and adds the line `note` there if the disk has space. `from` is
    /// the position [bytes] of the start of any row near the end: the last row is searched from there.
    void cut_to_rows(std::uint64_t from, std::string_view note);
    /// Cuts the new file after this number of bytes.
    void cut_to(std::uint64_t bytes);

private:
    int descriptor_ = -1;
    std::string path_;
    std::string set_aside_;
};

}  // namespace nezumi
