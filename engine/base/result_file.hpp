// A file that a run writes while it goes on. The older file with its name is kept until the new one is complete.
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
    /// The file without links; empty: it is a device or a pipe, and can be neither read again nor removed.
    const std::string& path() const { return path_; }
    /// The path of the older file; empty if there was none.
    const std::string& set_aside() const { return set_aside_; }
    /// ", and what was there before is now FILE~": an addition to the message that the new file is not complete; "" if
    /// there was no older file.
    std::string told_of_older() const;

    // Call these functions after the descriptor is closed.

    /// The new file is complete: removes the older one.
    void replace_older();
    /// There is no new file: the older one gets its name back.
    void discard();
    /// Keeps what could be written, up to its last complete row, with `note` as a line after it if there is room.
    /// `from` is the start of a row some bytes before the end [bytes].
    void cut_to_rows(std::uint64_t from, std::string_view note);
    /// Keeps the first bytes.
    void cut_to(std::uint64_t bytes);

private:
    int descriptor_ = -1;
    std::string path_;
    std::string set_aside_;
};

}  // namespace nezumi
