// Writes text to a file without ever throwing: fmt::print does where a terminal is gone or a disk is full.
#pragma once

#include <cstdio>
#include <string_view>

namespace nezumi {

/// Returns whether all of it got through, as far as the file's own buffer can tell.
inline bool put_text(std::FILE* file, std::string_view text) noexcept {
    return std::fwrite(text.data(), 1, text.size(), file) == text.size();
}

}  // namespace nezumi
