// Writes text to a file without exceptions; fmt::print throws if a terminal is gone or a disk is full.
#pragma once

#include <cstdio>
#include <string_view>

namespace nezumi {

/// Returns whether everything was written, as far as the buffer of the file can tell.
inline bool put_text(std::FILE* file, std::string_view text) noexcept {
    return std::fwrite(text.data(), 1, text.size(), file) == text.size();
}

}  // namespace nezumi
