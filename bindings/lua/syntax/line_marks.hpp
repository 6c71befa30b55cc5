// Adds marks to a Lua text: assignments that note which of its lines and branches run.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace nezumi {

/// The name of the table whose fields a marked text sets. The text's main function gets this table as its argument.
inline constexpr std::string_view marks_name = "nezumi_marks";

/// A text that sets `nezumi_marks[i] = 1` where mark `i` (from 1) is passed. It has the same lines and
/// results as the original.
struct MarkedText {
    /// An `if`, `elseif`, `while` or `for`, which can go two ways: execute its block, or not.
    struct Branch {
        int line = 0;
        std::size_t taken = 0;              ///< the mark of its block
        std::vector<std::size_t> passed{};  ///< marks of the other way: any of them shows it. Empty: unknown
    };

    std::string text;          ///< "": the original can't be marked: it has a syntax error, or uses `...` at its top
    std::vector<int> lines{};  ///< for each mark the line of its statement; 0: the mark is only for a branch
    std::vector<Branch> branches{};
};

/// Marks each statement except labels. `source` is a file's text without its preamble.
MarkedText mark_lines(std::string_view source);

}  // namespace nezumi
