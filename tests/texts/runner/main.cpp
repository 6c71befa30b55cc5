// Reads the cases of tests/texts, compares what they say with what is expected beside their lines, and tells each
// difference. Usage: texts [--root FOLDER] [--renew] [FILE [SENTENCE]]
//   --root FOLDER   in place of tests/texts
//   --renew         writes what is said in place of what was expected
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "reader.hpp"
#include "tests/unit/source_root.hpp"
#include "text_file.hpp"

namespace nezumi::texts {
namespace {

// Whether a line is as expected, where "..." stands for anything.
bool matches(std::string_view line, std::string_view expected) {
    const std::size_t dots = expected.find("...");
    if (dots == std::string_view::npos) return line == expected;
    if (line.substr(0, dots) != expected.substr(0, dots)) return false;
    const std::string_view rest = expected.substr(dots + 3);
    for (std::size_t at = dots; at <= line.size(); ++at) {
        if (matches(line.substr(at), rest)) return true;
    }
    return false;
}

bool matches(const Remark& said, const Remark& expected) {
    const bool place =
        said.line == 0 ? expected.column == 0 : said.line == expected.line && said.column == expected.column;
    return said.word == expected.word && place && matches(said.text, expected.text);
}

// Several lines: alone in its line, "..." stands for any lines.
bool matches(const std::vector<std::string>& lines, std::size_t at, const std::vector<std::string>& expected,
             std::size_t wanted) {
    if (wanted == expected.size()) return at == lines.size();
    if (expected[wanted] == "...") {
        for (std::size_t next = at; next <= lines.size(); ++next) {
            if (matches(lines, next, expected, wanted + 1)) return true;
        }
        return false;
    }
    return at < lines.size() && matches(lines[at], expected[wanted]) && matches(lines, at + 1, expected, wanted + 1);
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        lines.push_back(visible(std::string_view(text).substr(at, end - at)));
        at = end + 1;
    }
    return lines;
}

class Run {
public:
    Run(std::filesystem::path texts, std::filesystem::path file, bool renew)
        : texts_(std::move(texts)), file_(std::move(file)), renew_(renew) {}

    /// The number of cases that are not as expected, all or the one that is named; nothing is printed of the others.
    Expected<int> cases(const std::string& name) {
        auto read = read_text_file(texts_, file_);
        if (!read) return Unexpected(read.error());
        int failed = 0;
        int found = 0;
        for (const Case& each : read->cases) {
            if (!name.empty() && each.name != name) continue;
            ++found;
            const auto reader = make_reader(read->kind);
            if (!reader) return failure(fmt::format("nothing reads the folder '{}'", read->kind), {file_.string()});
            failed += run(each, *reader) ? 0 : 1;
        }
        if (found == 0) return failure(fmt::format("there is no case '{}'", name), {file_.string()});
        count_ = found;
        if (renew_ && !changes_.empty()) write(read->lines);
        return failed;
    }
    int count() const { return count_; }

private:
    bool run(const Case& each, CaseReader& reader) {
        const bool transcript = file_.extension() == ".txt";
        const bool named =
            std::all_of(each.texts.begin(), each.texts.end(), [](const Text& text) { return !text.name.empty(); });
        for (const Text& text : each.texts) {
            if (!transcript && !text.name.empty()) reader.write(text.name, text.code);
        }
        bool well = true;
        for (const Text& text : each.texts) {
            if (transcript && !text.name.empty())
                reader.write(text.name, text.code);
            else if (transcript)
                well = compare_answer(text, reader.answer(text.code)) && well;
            else if (text.name.empty() || named)
                well = compare(text, reader.read(text)) && well;
        }
        return well;
    }

    void tell(int line, int column, const std::string& what) const {
        const std::string place = column > 0 ? fmt::format("{}:{}", line, column) : std::to_string(line);
        fmt::print("{}:{}: {}\n", file_.string(), place, what);
    }

    bool compare(const Text& text, std::vector<Remark> said) {
        for (Remark& remark : said) remark.text = visible(remark.text);
        std::vector<Remark> expected = text.expected;
        for (Remark& remark : expected) remark.text = visible(remark.text);
        std::vector<Remark> unexpected;
        const int first = text.line - 1 + (text.name.empty() ? 0 : 1);
        for (const Remark& remark : said) {
            // What is printed comes in its order, errors are where they are.
            const auto found = std::find_if(expected.begin(), expected.end(), [&](const Remark& each) {
                return remark.word == "prints" ? each.word == "prints" : matches(remark, each);
            });
            if (found != expected.end() && matches(remark, *found))
                expected.erase(found);
            else
                unexpected.push_back(remark);
        }
        if (unexpected.empty() && expected.empty()) return true;
        for (const Remark& remark : expected)
            tell(first + remark.line, remark.column,
                 fmt::format("expected, and it is not said: {}: {}", remark.word, remark.text));
        for (const Remark& remark : unexpected)
            tell(first + std::max(remark.line, 1), remark.column,
                 fmt::format("said, and it is not expected: {}: {}", remark.word, remark.text));
        renew(text, std::move(said));
        return false;
    }

    bool compare_answer(const Text& text, const std::string& answer) {
        std::vector<std::string> expected = lines_of(text.answer);
        std::vector<std::string> said = lines_of(answer);
        while (!said.empty() && said.back().empty()) said.pop_back();
        if (matches(said, 0, expected, 0)) return true;
        tell(text.line, 0, "another answer:");
        for (const std::string& line : expected) fmt::print("  - {}\n", line);
        for (const std::string& line : said) fmt::print("  + {}\n", line);
        if (!renew_) return false;
        std::vector<std::string> lines;
        for (const std::string& line : text.lines) {
            if (line.starts_with("> ") || line.starts_with(">>") || line.starts_with("$ ")) lines.push_back(line);
        }
        lines.insert(lines.end(), said.begin(), said.end());
        if (text.lines.back().empty()) lines.emplace_back();
        changes_.push_back({text.line, text.lines.size(), std::move(lines)});
        return false;
    }

    // What is about no line is put where it was expected before, or where the text prints or returns.
    void renew(const Text& text, std::vector<Remark> said) {
        if (!renew_) return;
        const int offset = text.name.empty() ? 0 : 1;
        std::vector<int> printing;
        int last = 1;
        int returning = 0;
        for (std::size_t i = static_cast<std::size_t>(offset); i < text.lines.size(); ++i) {
            const int line = static_cast<int>(i) + 1 - offset;
            const std::string& code = text.lines[i];
            if (code.find_first_not_of(' ') == code.find("-- ") && i > 0) continue;
            last = line;
            if (code.find("print(") != std::string::npos || code.find("log.") != std::string::npos)
                printing.push_back(line);
            if (code.find("return") != std::string::npos) returning = line;
        }
        std::size_t printed = 0;
        for (Remark& remark : said) {
            if (remark.word == "prints" && !printing.empty())
                remark.line = printing[std::min(printed++, printing.size() - 1)];
            else if (remark.word == "returns")
                remark.line = returning > 0 ? returning : last;
            else if (remark.line == 0)
                remark.line = last;
        }
        changes_.push_back({text.line, text.lines.size(), lines_with(text, said)});
    }

    void write(const std::vector<std::string>& before) const {
        std::ofstream out(file_);
        std::size_t at = 0;
        for (const Change& change : changes_) {
            for (; at < static_cast<std::size_t>(change.line) - 1; ++at) out << before[at] << '\n';
            for (const std::string& line : change.lines) out << line << '\n';
            at += change.count;
        }
        for (; at < before.size(); ++at) out << before[at] << '\n';
    }

    struct Change {
        int line = 0;
        std::size_t count = 0;
        std::vector<std::string> lines;
    };

    std::filesystem::path texts_;
    std::filesystem::path file_;
    bool renew_;
    int count_ = 0;
    std::vector<Change> changes_;
};

int main_of(std::vector<std::string> words) {
    std::filesystem::path texts = root / "tests/texts";
    if (words.size() > 1 && words.front() == "--root") {
        texts = words[1];
        words.erase(words.begin(), words.begin() + 2);
    }
    const bool renew = !words.empty() && words.front() == "--renew";
    if (renew) words.erase(words.begin());
    std::vector<std::filesystem::path> files;
    if (!words.empty()) {
        files.emplace_back(words.front());
    } else {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(texts)) {
            const auto extension = entry.path().extension();
            if (extension == ".lua" || (extension == ".txt" && entry.path().filename() != "CMakeLists.txt"))
                files.push_back(entry.path());
        }
        std::sort(files.begin(), files.end());
    }
    int failed = 0;
    int count = 0;
    for (const auto& file : files) {
        Run run(texts, file, renew);
        try {
            const auto outcome = run.cases(words.size() > 1 ? words[1] : "");
            if (!outcome) fmt::print("{}\n", describe(outcome.error()));
            failed += outcome.value_or(1);
        } catch (const std::exception& error) {
            fmt::print("{}: {}\n", file.string(), error.what());
            ++failed;
        }
        count += run.count();
    }
    if (words.size() < 2) fmt::print("{} case{}, {} not as expected\n", count, count == 1 ? "" : "s", failed);
    return failed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace nezumi::texts

int main(int argc, char** argv) { return nezumi::texts::main_of({argv + 1, argv + argc}); }
