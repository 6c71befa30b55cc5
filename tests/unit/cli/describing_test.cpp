// What shells and man are told of the command line is what it takes.
#include <catch2/catch.hpp>

#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "bindings/cli/program.hpp"
#include "bindings/cli/shell/completion.hpp"
#include "bindings/cli/shell/manual.hpp"
#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;
using namespace nezumi::cli;

namespace {

bool has_program(const std::string& name) {
    return std::system(("command -v " + name + " >/dev/null 2>&1").c_str()) == 0;
}

// What a command of the shell says on both its outputs.
std::string said_by(const std::string& command) {
    std::string text;
    std::FILE* const pipe = popen((command + " 2>&1").c_str(), "r");
    REQUIRE(pipe != nullptr);
    char buffer[4096];
    while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, pipe)) text.append(buffer, count);
    pclose(pipe);
    return text;
}

// What bash offers for a line of these words, the last of which is being typed; sorted.
std::string offered(const Scratch& files, const std::string& words, int count) {
    const std::string script = files.write("nezumi.bash", completion_script(program(), "bash")).string();
    return said_by("cd " + files.path("").string() + " && bash -c 'source " + script + "; COMP_WORDS=(" + words +
                   "); COMP_CWORD=" + std::to_string(count - 1) +
                   "; _nezumi; printf \"%s\\n\" \"${COMPREPLY[@]}\" | LC_ALL=C sort | paste -sd\" \"'");
}

}  // namespace

TEST_CASE("bash completes commands, options, words and files", "[cli][completion]") {
    const Scratch files;
    files.write("room.lua", "");
    CHECK(offered(files, "nezumi ma", 2) == "manual marker maze\n");
    CHECK(offered(files, "nezumi new \"\"", 3) == "behavior exercise project robot scenario system\n");
    CHECK(offered(files, "nezumi new behaviour --pa", 4) == "--param\n");
    CHECK(offered(files, "nezumi run --he", 3) == "--headless --help\n");
    CHECK(offered(files, "nezumi new -", 3) == "--help -h\n");
    CHECK(offered(files, "nezumi run ro", 3) == "room.lua\n");
    CHECK(offered(files, "nezumi run \"\"", 3) == "nezumi.bash room.lua\n");
    CHECK(offered(files, "nezumi run --seed -", 4) == "\n");
    CHECK(offered(files, "nezumi run --speed m", 4) == "max\n");
    CHECK(offered(files, "nezumi run --speed = m", 5) == "max\n");
    CHECK(offered(files, "nezumi run --speed =", 4) == "max\n");
    CHECK(offered(files, "nezumi run --record ro", 4) == "room.lua\n");
    CHECK(offered(files, "nezumi run --seed ro", 4) == "\n");
    CHECK(offered(files, "nezumi completion z", 3) == "zsh\n");
    CHECK(offered(files, "nezumi attach run --li", 4) == "--list\n");
}

TEST_CASE("the completion scripts are well-formed for each installed shell", "[cli][completion]") {
    const Scratch files;
    std::string missing;
    for (const std::string shell : {"bash", "zsh", "fish"}) {
        if (!has_program(shell)) {
            missing += " " + shell;
            continue;
        }
        INFO(shell);
        const std::string script = files.write("script." + shell, completion_script(program(), shell)).string();
        REQUIRE(said_by(shell + " -n " + script) == "");
    }
    if (!missing.empty()) throw std::runtime_error("SKIPPED: not installed: sudo apt install" + missing);
    const std::string script = files.path("script.fish").string();
    CHECK(said_by("fish --no-config -c 'source " + script +
                  "; complete -C \"nezumi ma\"' | cut -f 1 | LC_ALL=C sort") == "manual\nmarker\nmaze\n");
    CHECK(said_by("fish --no-config -c 'source " + script +
                  "; complete -C \"nezumi new behaviour --pa\"' | cut -f 1") == "--param\n");
}

TEST_CASE("every script knows every command and option", "[cli][completion]") {
    const SubCommand whole = program();
    for (const std::string_view shell : completed_shells()) {
        const std::string script = completion_script(whole, shell);
        for (const SubCommand& command : whole.commands) {
            CHECK(script.find("nezumi " + command.name) != std::string::npos);
            for (const Option& option : command.options) {
                if (is_positional(option)) continue;
                const std::string name = names_of(option).back();
                INFO(shell << ": " << name);
                CHECK(script.find(shell == "fish" ? "-l " + name.substr(2) : name) != std::string::npos);
            }
        }
    }
    CHECK(run_nezumi({"completion", "fish"}).out == completion_script(whole, "fish"));
    CHECK(run_nezumi({"completion", "bsh"}).error ==
          "nezumi: completion: there is no completion for the shell 'bsh' (did you mean 'bash'?); known are bash, zsh, "
          "fish\n");
}

TEST_CASE("the form of a value decides its completion", "[cli][completion]") {
    std::string text;
    bool flag = false;
    const auto words = [&](const std::string& name, const std::string& form) {
        const ValueWords value = value_words({name, &text, "", form});
        std::string all = value.files ? "files" : "";
        for (const std::string& word : value.words) all += (all.empty() ? "" : " ") + word;
        return all;
    };
    CHECK(words("FILE", "") == "files");
    CHECK(words("[PATHS]", "") == "files");
    CHECK(words("[SYSTEM]", "") == "");
    CHECK(words("--picture", "FILE.png|svg") == "files");
    CHECK(words("--speed", "N|max") == "max");
    CHECK(words("--in", "name:Type") == "");
    CHECK(words("SHELL", "bash|zsh|fish") == "bash zsh fish");
    CHECK_FALSE(value_words({"--fast", &flag, ""}).files);
}

TEST_CASE("the manual has a page for each command, with every option, and man finds nothing wrong", "[cli][manual]") {
    const Scratch files;
    const std::string folder = files.path("man").string();
    const Outcome wrote = run_nezumi({"manual", folder});
    CHECK(wrote.error.empty());
    const SubCommand whole = program();
    const auto pages = manual_pages(whole);
    REQUIRE(pages.size() == whole.commands.size() + 1);
    for (const ManualPage& page : pages) {
        INFO(page.name);
        REQUIRE(text_of_file(folder + "/" + page.name) == page.text);
        if (has_program("groff")) REQUIRE(said_by("groff -man -Tascii -ww -z " + folder + "/" + page.name) == "");
    }
    if (!has_program("groff")) throw std::runtime_error("SKIPPED: groff is not installed: sudo apt install groff-base");
    const auto read = [&](const std::string& name) {
        return said_by("groff -man -Tascii -P-cbou " + folder + "/" + name);
    };
    // Lines are filled: where they break and how wide their blanks are is groff's.
    const auto words = [&](const std::string& name) {
        std::istringstream in(read(name));
        std::string all;
        for (std::string word; in >> word;) all += word + " ";
        return all;
    };
    const std::string run = words("nezumi-run.1");
    CHECK(run.find("nezumi-run - run a system file: simulate it") != std::string::npos);
    CHECK(run.find("--seed N") != std::string::npos);
    CHECK(run.find("EXIT STATUS") != std::string::npos);
    CHECK(words("nezumi-test.1").find("-o, --output DIR") != std::string::npos);
    CHECK(words("nezumi-new.1").find("NEZUMI NEW BEHAVIOR") != std::string::npos);
    CHECK(words("nezumi.1").find("NAME nezumi - runs what small robots do") != std::string::npos);
    const std::string all = read("nezumi.1");
    for (const SubCommand& command : whole.commands) CHECK(all.find("\n       " + command.name) != std::string::npos);
}

TEST_CASE("a text of the manual is shown unchanged, even with commands of roff", "[cli][manual]") {
    bool flag = false;
    const SubCommand odd{
        .name = "tool",
        .help = ".so \\fBit\\fR's -- `odd`",
        .commands = {
            {.name = "run", .help = "'Runs", .options = {{"--fast", &flag, ".TH no"}}, .run = [] { return 0; }}}};
    const auto pages = manual_pages(odd);
    REQUIRE(pages.size() == 2);
    CHECK(pages[0].text.find("\n\\&.so \\efBit\\efR\\(aqs \\-\\- \\(gaodd\\(ga.\n") != std::string::npos);
    CHECK(pages[1].text.find("\n\\&.TH no\n") != std::string::npos);
}
