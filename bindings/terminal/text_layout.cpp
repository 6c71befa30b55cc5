// Widths are those of the C library, for the locale of the thread.
#include "bindings/terminal/text_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cwchar>

namespace nezumi {
namespace {

constexpr std::size_t most_listed = 200;

}  // namespace

int row_after(std::wstring_view text, int columns) {
    int row = 0;
    int column = 0;
    for (const wchar_t letter : text) {
        if (letter == L'\n') {
            ++row;
            column = 0;
            continue;
        }
        int width = letter == L'\t' ? 8 - column % 8 : wcwidth(letter);
        if (width < 0) width = 2;  // ^A
        if (column + width > columns) {
            ++row;
            column = 0;
        }
        column += width;
        if (column >= columns) {
            ++row;
            column = 0;
        }
    }
    return row;
}

std::string common_beginning(const std::vector<std::string>& candidates) {
    std::string common = candidates.front();
    for (const std::string& candidate : candidates) {
        const auto differ = std::mismatch(common.begin(), common.end(), candidate.begin(), candidate.end());
        common.erase(differ.first, common.end());
    }
    // Must not end within a character.
    const auto is_cut = [&common](const std::string& candidate) {
        return candidate.size() > common.size() &&
               (static_cast<unsigned char>(candidate[common.size()]) & 0xC0U) == 0x80U;
    };
    while (std::any_of(candidates.begin(), candidates.end(), is_cut)) common.pop_back();
    return common;
}

std::string in_columns(const std::vector<std::string>& candidates, int columns) {
    const std::size_t shown = std::min(candidates.size(), most_listed);
    std::size_t width = 0;
    for (std::size_t at = 0; at < shown; ++at) width = std::max(width, candidates[at].size());
    width += 2;
    const std::size_t in_row = std::max<std::size_t>(1, static_cast<std::size_t>(columns) / width);
    const std::size_t rows = (shown + in_row - 1) / in_row;
    std::string text;
    for (std::size_t row = 0; row < rows; ++row) {
        std::string line;
        for (std::size_t at = row; at < shown; at += rows) line += fmt::format("{:<{}}", candidates[at], width);
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + "\n";
    }
    if (shown < candidates.size()) text += fmt::format("and {} more\n", candidates.size() - shown);
    return text;
}

}  // namespace nezumi
