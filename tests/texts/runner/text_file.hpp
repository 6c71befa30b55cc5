// A file of texts: its cases, the texts of each, and what is expected beside which line.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi::texts {

/// What a text must say, or did say: an error at a line, a line that it printed.
struct Remark {
    std::string word;  ///< "error", "failed", "prints", "returns"
    int line = 0;      ///< of the text, from 1; 0: it is about no line of the text
    int column = 0;    ///< from 1; 0: it names none
    std::string text;
};

/// Lines of a file that are read as one: Lua with expectations, or the input of a transcript with its answer.
struct Text {
    std::string name;                ///< the name that `-- file: NAME` gives it; empty without
    int line = 0;                    ///< where it begins in the file, from 1
    std::vector<std::string> lines;  ///< as they are in the file
    std::string code;                ///< the lines without expectations
    std::vector<Remark> expected;    ///< in Lua
    std::string answer;              ///< in a transcript
};

struct Case {
    std::string name;  ///< the sentence of its heading
    int line = 0;      ///< of its heading
    std::vector<Text> texts;
};

struct TextFile {
    std::filesystem::path path;
    std::string kind;  ///< the folder of tests/texts that it is in
    std::vector<std::string> lines;
    std::vector<Case> cases;
};

/// Reads `ROOT/KIND/.../NAME.lua` or `.txt`. The error says which line is not as docs/testing.md describes.
Expected<TextFile> read_text_file(const std::filesystem::path& root, const std::filesystem::path& path);

/// The lines of a text with these expectations instead of its own.
std::vector<std::string> lines_with(const Text& text, const std::vector<Remark>& remarks);

/// A line as it is shown: a tab is two blanks, other control characters are escaped as in Lua, blanks at the end are
/// left out.
std::string visible(std::string_view line);

}  // namespace nezumi::texts
