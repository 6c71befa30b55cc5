// The pages of the documentation do what they say: their commands are run, in order, and their outputs compared.
//
// In a page, "```console" has commands after `$ ` and what they say; "..." stands for any text within a line, and alone
// in a line for any lines. "```lua FILE" or "```python FILE" writes a file; "```lua" is a part of a file that is there
// by then.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/unit/cli/need_landlock.hpp"
#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;

namespace {

namespace fs = std::filesystem;

struct Block {
    std::string kind, file;
    std::vector<std::string> lines;
    int line = 0;  // of the page
};

std::vector<Block> blocks_of(const std::string& page) {
    std::vector<Block> blocks;
    bool inside = false;
    int number = 0;
    for (const std::string& line : lines_of(page)) {
        ++number;
        if (line.starts_with("```")) {
            inside = !inside;
            if (!inside) continue;
            std::istringstream info(line.substr(3));
            Block block;
            info >> block.kind >> block.file;
            block.line = number;
            blocks.push_back(block);
        } else if (inside) {
            blocks.back().lines.push_back(line);
        }
    }
    return blocks;
}

// Whether a line is as expected, where "..." stands for anything.
bool matches(const std::string& line, const std::string& expected) {
    const std::size_t dots = expected.find("...");
    if (dots == std::string::npos) return line == expected;
    if (line.compare(0, dots, expected, 0, dots) != 0) return false;
    const std::string rest = expected.substr(dots + 3);
    for (std::size_t at = dots; at <= line.size(); ++at) {
        if (matches(line.substr(at), rest)) return true;
    }
    return false;
}

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

// A terminal in a folder of its own, with this build's nezumi on its path, and Debian's Python, which has NumPy.
class Terminal {
public:
    std::string run(const std::string& command) {
        const std::string bin = nezumi_program().substr(0, nezumi_program().rfind('/'));
        scratch_.write("command", "PATH='" + bin + "':/usr/bin:$PATH; export PYTHONDONTWRITEBYTECODE=1 PYTHONPATH='" +
                                      source_root() + "/bindings/python'; cd '" + folder_ + "'\n" + command +
                                      "\npwd > '" + scratch_.path("folder").string() + "'\n");
        const std::string shell = "sh '" + scratch_.path("command").string() + "' 2>&1 </dev/null";
        std::FILE* pipe = popen(shell.c_str(), "r");
        REQUIRE(pipe != nullptr);
        std::string said;
        char buffer[4096];
        for (std::size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) said.append(buffer, n);
        pclose(pipe);
        const auto now = lines_of(text_of_file(scratch_.path("folder")));
        if (!now.empty()) folder_ = now.front();
        return said;
    }
    fs::path file(const std::string& name) const { return fs::path(folder_) / name; }
    bool has_somewhere(const std::string& text) const {
        for (const auto& entry : fs::recursive_directory_iterator(scratch_.path("home"))) {
            if (entry.path().extension() == ".lua" && text_of_file(entry.path()).find(text) != std::string::npos)
                return true;
        }
        return false;
    }

private:
    Scratch scratch_;
    std::string folder_ = scratch_.write("home/.keep", "").parent_path().string();
};

void run_console(Terminal& terminal, const Block& block) {
    for (std::size_t i = 0; i < block.lines.size();) {
        REQUIRE(block.lines[i].starts_with("$ "));
        const std::string command = block.lines[i].substr(2);
        std::vector<std::string> expected;
        for (++i; i < block.lines.size() && !block.lines[i].starts_with("$ "); ++i) expected.push_back(block.lines[i]);
        const std::string said = terminal.run(command);
        CAPTURE(block.line, command, said);
        CHECK(matches(lines_of(said), 0, expected, 0));
    }
}

// `before`: a command that comes before those of the page.
void follow(const std::string& name, const std::string& folder = "", const std::string& before = "") {
    const std::string page = text_of_file(fs::path(source_root()) / "docs" / name);
    REQUIRE_FALSE(page.empty());
    Terminal terminal;
    if (!folder.empty()) terminal.run("cd '" + folder + "'");
    if (!before.empty()) terminal.run(before);
    for (const Block& block : blocks_of(page)) {
        std::string text;
        for (const std::string& line : block.lines) text += line + "\n";
        CAPTURE(name, block.line);
        if (block.kind == "console") {
            run_console(terminal, block);
        } else if (!block.file.empty()) {
            fs::create_directories(terminal.file(block.file).parent_path());
            std::ofstream(terminal.file(block.file)) << text;
        } else if (block.kind == "lua") {
            CHECK(terminal.has_somewhere(text));
        }
    }
}

std::vector<fs::path> pages() {
    std::vector<fs::path> all{root / "README.md", root / "CONTRIBUTING.md"};
    for (const auto& entry : fs::recursive_directory_iterator(root / "docs")) {
        if (entry.path().extension() == ".md") all.push_back(entry.path());
    }
    return all;
}

// What stands in a page between `begin` and the next `end`.
std::vector<std::string> parts_between(const std::string& page, const std::string& begin, char end) {
    std::vector<std::string> parts;
    for (std::size_t at = 0; (at = page.find(begin, at)) != std::string::npos;) {
        at += begin.size();
        parts.push_back(page.substr(at, page.find(end, at) - at));
    }
    return parts;
}

// The test cases of a room, as its sources write them.
struct Case {
    std::string name, tags;
};

std::vector<Case> cases_of(const fs::path& room) {
    std::vector<Case> cases;
    for (const auto& entry : fs::directory_iterator(room)) {
        if (entry.path().extension() != ".cpp") continue;
        for (const std::string& part : parts_between(text_of_file(entry.path()), "TEST_CASE(", '{')) {
            Case found;
            bool inside = false, is_name = true;
            for (const char c : part) {
                if (c == '"') {
                    inside = !inside;
                } else if (inside) {
                    (is_name ? found.name : found.tags) += c;
                } else if (c == ',') {
                    is_name = false;
                }
            }
            cases.push_back(found);
        }
    }
    return cases;
}

// Whether a pattern for unit tests means one: "[tag]", or a name, which `*` may cut off.
bool is_there(const std::string& pattern, const std::vector<Case>& cases) {
    return std::any_of(cases.begin(), cases.end(), [&](const Case& each) {
        if (pattern.starts_with('[')) return each.tags.find(pattern) != std::string::npos;
        if (pattern.ends_with('*')) return each.name.starts_with(pattern.substr(0, pattern.size() - 1));
        return each.name == pattern;
    });
}

}  // namespace

TEST_CASE("every link within the documentation leads to a file", "[cli][docs]") {
    std::size_t links = 0;
    for (const fs::path& page : pages()) {
        for (std::string link : parts_between(text_of_file(page), "](", ')')) {
            link = link.substr(0, link.find('#'));
            if (link.empty() || link.find("://") != std::string::npos) continue;
            CAPTURE(page.filename().string(), link);
            CHECK(fs::exists(page.parent_path() / link));
            ++links;
        }
    }
    CHECK(links > 30);
}

TEST_CASE("every source that the pages for developers name is there", "[cli][docs]") {
    std::size_t sources = 0;
    for (const char* page : {"CONTRIBUTING.md", "docs/architecture.md"}) {
        std::istringstream words(text_of_file(root / page));
        for (std::string word; words >> word;) {
            const std::size_t begin = word.find_first_not_of("`(");
            if (begin == std::string::npos) continue;
            word = word.substr(begin, word.find_first_of("`),:;", begin) - begin);
            const bool is_source = word.ends_with(".cpp") || word.ends_with(".hpp") || word.ends_with(".lua");
            if (!is_source || word.find('/') == std::string::npos || word.find('*') != std::string::npos) continue;
            CAPTURE(page, word);
            CHECK(fs::exists(root / word));
            ++sources;
        }
    }
    CHECK(sources > 20);
}

TEST_CASE("every unit test that a page names is there", "[cli][docs]") {
    const fs::path rooms = root / "tests/unit";
    CHECK_FALSE(is_there("[no such tag]", cases_of(rooms / "cli")));
    CHECK_FALSE(is_there("no such name*", cases_of(rooms / "cli")));
    std::size_t patterns = 0;
    for (const fs::path& page : pages()) {
        const std::string text = text_of_file(page);
        for (std::size_t at = 0; (at = text.find("unit_", at)) != std::string::npos;) {
            at += std::string("unit_").size();
            const std::size_t end = text.find_first_not_of("abcdefghijklmnopqrstuvwxyz", at);
            const std::size_t quote = text.find_first_not_of(" \n", end);
            if (quote == std::string::npos || quote == end || (text[quote] != '\'' && text[quote] != '"')) continue;
            const std::string room = text.substr(at, end - at);
            const std::string pattern = text.substr(quote + 1, text.find(text[quote], quote + 1) - quote - 1);
            CAPTURE(page.filename().string(), room, pattern);
            REQUIRE(fs::is_directory(rooms / room));
            CHECK(is_there(pattern, cases_of(rooms / room)));
            ++patterns;
        }
    }
    CHECK(patterns > 25);
}

TEST_CASE("every check that the page for papers names is a test", "[cli][docs]") {
    std::vector<Case> cases;
    for (const char* room : {"engine", "sim"}) {
        for (Case& each : cases_of(root / "tests/unit" / room)) cases.push_back(std::move(each));
    }
    const std::string page = text_of_file(root / "docs/methods.md");
    const std::size_t begin = page.find("| quantity, and what it is compared with | test |");
    REQUIRE(begin != std::string::npos);
    std::istringstream rows(page.substr(begin, page.find("\n\n", begin) - begin));
    std::string row;
    std::getline(rows, row);
    std::getline(rows, row);
    std::size_t checks = 0;
    while (std::getline(rows, row)) {
        const std::string name = parts_between(row, " | ", '|').at(0);
        CAPTURE(name);
        CHECK(is_there(name.substr(0, name.find_last_not_of(' ') + 1), cases));
        ++checks;
    }
    CHECK(checks > 15);
}

TEST_CASE("the program that the README embeds nezumi in is the one that is tried", "[cli][docs]") {
    const std::map<std::string, fs::path> files{{"cmake", "tests/consumer/CMakeLists.txt"},
                                                {"cpp", "tests/consumer/main.cpp"}};
    std::size_t compared = 0;
    for (const Block& block : blocks_of(text_of_file(root / "README.md"))) {
        const auto file = files.find(block.kind);
        if (file == files.end()) continue;
        std::string text;
        for (const std::string& line : block.lines) text += line + "\n";
        CAPTURE(block.line, text);
        CHECK(text_of_file(root / file->second).find("\n" + text) != std::string::npos);
        ++compared;
    }
    CHECK(compared == 2);
}

TEST_CASE("the page about the architecture lists the engine's rooms as the doors have them", "[cli][docs]") {
    const auto doors = parts_between(text_of_file(root / "tests/lint/doors"), "split(\"", '"');
    REQUIRE_FALSE(doors.empty());
    std::string listed;
    for (const std::string& room : parts_between(text_of_file(root / "docs/architecture.md"), "\n| `engine/", '`')) {
        if (room != "robots") listed += (listed.empty() ? "" : " ") + room;
    }
    CHECK(listed == doors.front());
}

TEST_CASE("the commands on the page about editors give the documented results", "[cli][docs]") { follow("editors.md"); }

TEST_CASE("the commands on the page about the console give the documented results", "[cli][docs]") {
    follow("console.md");
}

TEST_CASE("the commands on the page about going back in time give the documented results", "[cli][docs]") {
    follow("time.md");
}

TEST_CASE("the commands on the page about the seminar's systems give the documented results", "[cli][docs]") {
    follow("seminar.md", source_root());
}

TEST_CASE("the commands of the tutorial give the documented results", "[cli][docs][wallclock]") {
    follow("tutorial.md");
}

TEST_CASE("the commands of the tutorial in Japanese give the documented results", "[cli][docs][wallclock]") {
    follow("ja/tutorial.md");
}

TEST_CASE("the commands on the seminar's page in Japanese give the documented results", "[cli][docs]") {
    follow("ja/seminar.md", source_root());
}

TEST_CASE("the commands on the page about classes in Japanese give the documented results", "[cli][docs]") {
    need_landlock();
    follow("ja/classroom.md", "", "mkdir robots-7b");
}

TEST_CASE("each page in Japanese and its English one lead to each other and have as many sections and commands",
          "[cli][docs]") {
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(root / "docs/ja")) {
        const std::string name = entry.path().filename().string();
        const bool is_readme = name == "README.md";
        const std::string japanese = text_of_file(entry.path());
        const std::string english = text_of_file(is_readme ? root / name : root / "docs" / name);
        CAPTURE(name);
        CHECK(english.find("[日本語](" + std::string(is_readme ? "docs/" : "") + "ja/" + name + ")") !=
              std::string::npos);
        CHECK(japanese.find("[English](" + std::string(is_readme ? "../../" : "../") + name + ")") !=
              std::string::npos);
        const auto commands = [](const std::string& page) {
            std::size_t found = 0;
            for (const Block& block : blocks_of(page)) {
                for (const std::string& line : block.lines) found += line.starts_with("$ ") ? 1 : 0;
            }
            return found;
        };
        CHECK(commands(japanese) == commands(english));
        // The depth of each heading. The README in Japanese is a short one.
        const auto sections = [](const std::string& page) {
            std::vector<std::size_t> depths;
            bool is_text = true;
            std::istringstream lines(page);
            for (std::string line; std::getline(lines, line);) {
                if (line.starts_with("```")) is_text = !is_text;
                const std::size_t depth = line.find_first_not_of('#');
                if (is_text && depth != 0 && depth != std::string::npos && line[depth] == ' ') depths.push_back(depth);
            }
            return depths;
        };
        if (!is_readme) CHECK(sections(japanese) == sections(english));
        ++count;
    }
    CHECK(count >= 4);
}

TEST_CASE("the commands on the page about behaviours give the documented results", "[cli][docs][watchdog]") {
    follow("behaviors.md");
}

TEST_CASE("the commands on the page about the examples give the documented results", "[cli][docs]") {
    follow("examples.md", source_root());
}

TEST_CASE("the commands on the page about OpenRTM's components give the documented results", "[cli][docs]") {
    follow("openrtm.md");
}

TEST_CASE("the commands on the page about Python give the documented results", "[cli][docs]") { follow("python.md"); }

TEST_CASE("the commands on the page for users of other programs give the documented results", "[cli][docs]") {
    follow("coming_from.md");
}

TEST_CASE("the commands on the page about coverage give the documented results", "[cli][docs]") {
    follow("coverage.md");
}

TEST_CASE("the commands on the page about sweeps give the documented results", "[cli][docs]") { follow("sweeps.md"); }

TEST_CASE("the commands on the page about finding reasons give the documented results", "[cli][docs]") {
    follow("why.md");
}

TEST_CASE("the commands on the page for papers give the documented results", "[cli][docs]") { follow("methods.md"); }

TEST_CASE("the commands on the page about upgrading give the documented results", "[cli][docs]") {
    follow("upgrading.md");
}

TEST_CASE("the commands on the page about Micromouse give the documented results", "[cli][docs]") {
    follow("micromouse.md");
}

TEST_CASE("the commands on the page about learning give the documented results", "[cli][docs]") {
    follow("learning.md");
}

TEST_CASE("the commands on the page about agents give the documented results", "[cli][docs]") { follow("agents.md"); }

TEST_CASE("the commands on the page about classes give the documented results", "[cli][docs]") {
    need_landlock();
    follow("classroom.md", "", "mkdir robots-7b");
}

TEST_CASE("every example has a picture", "[cli][docs]") {
    const std::string page = text_of_file(root / "docs/examples.md");
    const auto names = parts_between(page, "\n| [", ']');
    CHECK(names.size() >= 8);
    for (const std::string& name : names) {
        CAPTURE(name);
        CHECK(fs::exists(root / "behaviors/systems" / (name + ".lua")));
        CHECK(page.find("](images/" + name + ".png)") != std::string::npos);
    }
}

TEST_CASE("the commands on the page about messages give the documented results", "[cli][docs]") {
    follow("messages.md");
}

TEST_CASE("the commands on the page about modules give the documented results", "[cli][docs]") { follow("modules.md"); }

TEST_CASE("the commands on the page about the Raspberry Pi Mouse give the documented results", "[cli][docs]") {
    follow("raspimouse.md");
}
