// A file that a run writes while it goes on, and the older file of its name, which is kept until the new one is whole.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "engine/base/error.hpp"

namespace nezumi {

/// What is there already is set aside as "FILE~" first (or "FILE~2", ..., where that is taken). Devices and pipes are
/// written as they are.
class ResultFile {
public:
    /// An error says why the file can't be written, as a pipe that nobody reads; then it is as it was.
    static Expected<ResultFile> open(const std::string& file);

    /// Open for writing, empty; to be closed by whoever takes it.
    int descriptor() const { return descriptor_; }
    /// The file without links; empty: it is a device or a pipe, and can be neither read again nor taken away.
    const std::string& path() const { return path_; }
    /// Where the older file is; empty when there was none.
    const std::string& set_aside() const { return set_aside_; }
    /// ", and what was there before is now FILE~", behind a message that the new one is not whole; "" where nothing
    /// was.
    std::string told_of_older() const;

    // All three once the descriptor is closed.

    /// The new file is whole: the older one goes.
    void replace_older();
    /// There is no new file: the older one has its name again.
    void discard();
    /// What could be written stays, up to its last whole row, with `note` as a line behind it where there is room for
    /// it. `from` is where a row begins and some bytes before the end [bytes].
    void cut_to_rows(std::uint64_t from, std::string_view note);

private:
    int descriptor_ = -1;
    std::string path_;
    std::string set_aside_;
};

}  // namespace nezumi
