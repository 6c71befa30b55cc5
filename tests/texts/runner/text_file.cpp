#include "text_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <regex>
#include <set>

namespace nezumi::texts {
namespace {

constexpr std::string_view heading = "--- ";
constexpr std::string_view file_mark = "-- file: ";
constexpr std::size_t widest = 130;  // columns of a line with its expectation

std::string trimmed_right(std::string_view text) {
    const std::size_t end = text.find_last_not_of(" \t\r\n");
    return std::string(text.substr(0, end == std::string_view::npos ? 0 : end + 1));
}

// An expectation in a line: what it says, and what of the line is code.
struct Found {
    Remark remark;
    std::string code;
};

std::optional<Found> expectation_in(const std::string& line) {
    static const std::regex pattern(R"(--( *\^)? +(error|failed|prints|returns)( at column ([0-9]+))?:( (.*))?$)");
    std::smatch match;
    if (!std::regex_search(line, match, pattern)) return std::nullopt;
    Found found;
    found.code = trimmed_right(match.prefix().str());
    found.remark = {.word = match[2], .text = match[6]};
    if (match[1].matched) found.remark.column = static_cast<int>(match.position(1) + match.length(1));
    if (match[4].matched) found.remark.column = std::stoi(match[4]);
    return found;
}

// Takes lines one by one into the cases of a file.
class Reader {
public:
    explicit Reader(TextFile& file) : file_(file), is_transcript_(file.path.extension() == ".txt") {}

    Expected<void> take(const std::string& line) {
        ++number_;
        if (line.starts_with(heading)) return take_heading(line.substr(heading.size()));
        if (file_.cases.empty()) return {};
        if (is_transcript_ && take_prompt(line)) return {};
        if (line.starts_with(file_mark)) {
            begin(line.substr(file_mark.size()));
            text_->lines.push_back(line);
            text_->code = "";
            return {};
        }
        if (is_transcript_ && text_ == nullptr) {
            if (!trimmed_right(line).empty()) return wrong("expected an input after '> ' or '$ '");
            return {};
        }
        if (is_transcript_) {
            (text_->name.empty() ? text_->answer : text_->code) += line + "\n";
            text_->lines.push_back(line);
            return {};
        }
        return take_lua(line);
    }

    Expected<void> end() {
        end_text();
        for (const Case& each : file_.cases) {
            if (each.texts.empty()) return failure("a case without a text", {file_.path.string(), each.line});
        }
        if (file_.cases.empty())
            return failure("expected a case: a line `--- What happens.`", {file_.path.string(), number_});
        return {};
    }

private:
    Unexpected wrong(std::string message) const { return failure(std::move(message), {file_.path.string(), number_}); }

    Expected<void> take_heading(const std::string& line) {
        end_text();
        const std::string name = trimmed_right(line);
        if (name.find_first_of(";[]") != std::string::npos)
            return wrong("a sentence with one of ; [ ], which ctest can't list");
        if (!names_.insert(name).second) return wrong("another case of this file has the same name");
        file_.cases.push_back({.name = name, .line = number_});
        return {};
    }

    // "> INPUT" and ">> MORE OF IT" are a console's, "$ COMMAND" a shell's.
    bool take_prompt(const std::string& line) {
        const bool more = line.starts_with(">> ") || line == ">>";
        if (!more && !line.starts_with("> ") && !line.starts_with("$ ")) return false;
        if (!more || text_ == nullptr) {
            begin("");
            text_->code = line.substr(2);
        } else {
            text_->code += "\n" + (line == ">>" ? "" : line.substr(3));
        }
        text_->lines.push_back(line);
        return true;
    }

    Expected<void> take_lua(const std::string& line) {
        if (trimmed_right(line).empty()) {
            end_text();
            return {};
        }
        if (text_ == nullptr) begin("");
        text_->lines.push_back(line);
        auto found = expectation_in(line);
        if (!found) {
            text_->code += line + "\n";
            code_line_ = static_cast<int>(text_->lines.size());
            return {};
        }
        if (found->code.empty()) {
            if (code_line_ == 0 && text_->lines.size() > 1) code_line_ = 1;
        } else {
            code_line_ = static_cast<int>(text_->lines.size());
        }
        text_->code += found->code + "\n";
        found->remark.line = code_line_ - offset();
        text_->expected.push_back(std::move(found->remark));
        return {};
    }

    // Lines before the first of the text: its name.
    int offset() const { return text_->name.empty() ? 0 : 1; }

    void begin(const std::string& name) {
        end_text();
        file_.cases.back().texts.push_back({.name = trimmed_right(name), .line = number_});
        text_ = &file_.cases.back().texts.back();
        code_line_ = 0;
    }

    void end_text() {
        if (text_ == nullptr) return;
        text_->answer = trimmed_right(text_->answer);
        if (!is_transcript_) text_->code = trimmed_right(text_->code);
        text_ = nullptr;
    }

    TextFile& file_;
    bool is_transcript_;
    int number_ = 0;
    Text* text_ = nullptr;
    int code_line_ = 0;  // the latest line of the text that is code
    std::set<std::string> names_;
};

// The expectation as it is written below a line, or at its end where there is room.
std::string comment(const Remark& remark) {
    std::string text = remark.text.empty() ? "" : " " + remark.text;
    if (remark.column >= 3) return fmt::format("--{:>{}} {}:{}", "^", remark.column - 2, remark.word, text);
    if (remark.column > 0) return fmt::format("-- {} at column {}:{}", remark.word, remark.column, text);
    return fmt::format("-- {}:{}", remark.word, text);
}

}  // namespace

std::string visible(std::string_view line) {
    std::string shown;
    for (const char c : line) {
        const auto code = static_cast<unsigned char>(c);
        if (c == '\n')
            shown += "\\n";
        else if (c == '\t')
            shown += "  ";
        else if (code < 32 || code == 127)
            shown += fmt::format("\\x{:02x}", code);
        else
            shown += c;
    }
    return trimmed_right(shown);
}

Expected<TextFile> read_text_file(const std::filesystem::path& root, const std::filesystem::path& path) {
    TextFile file;
    file.path = path;
    const std::filesystem::path inside = std::filesystem::absolute(path).lexically_relative(root);
    file.kind = inside.begin() == inside.end() ? "" : inside.begin()->string();
    std::ifstream in(path);
    if (!in) return failure("can't be read", {path.string()});
    Reader reader(file);
    for (std::string line; std::getline(in, line);) {
        file.lines.push_back(line);
        if (auto taken = reader.take(line); !taken) return Unexpected(taken.error());
    }
    if (auto ended = reader.end(); !ended) return Unexpected(ended.error());
    return file;
}

std::vector<std::string> lines_with(const Text& text, const std::vector<Remark>& remarks) {
    std::vector<std::string> lines;
    const int offset = text.name.empty() ? 0 : 1;
    for (std::size_t i = 0; i < text.lines.size(); ++i) {
        const auto found = expectation_in(text.lines[i]);
        if (found && found->code.empty()) continue;
        std::string line = found ? found->code : text.lines[i];
        std::vector<std::string> below;
        for (const Remark& remark : remarks) {
            if (remark.line != static_cast<int>(i) + 1 - offset) continue;
            const std::string written = comment(remark);
            const bool fits =
                below.empty() && line.find(" -- ") == std::string::npos && line.size() + 2 + written.size() <= widest;
            if (remark.column < 3 && fits)
                line += "  " + written;
            else
                below.push_back(written);
        }
        lines.push_back(line);
        lines.insert(lines.end(), below.begin(), below.end());
    }
    return lines;
}

}  // namespace nezumi::texts
