// The command line is described once: what is parsed, what is refused, what --help says.
#include "bindings/cli/shell/command_line.hpp"

#include <catch2/catch.hpp>

#include <filesystem>
#include <string>
#include <vector>

#include "bindings/cli/commands/commands.hpp"
#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;
using namespace nezumi::cli;

namespace {

struct Values {
    std::string file;
    bool fast = false;
    std::string name = "none";
    std::optional<std::string> text;
    std::vector<std::string> many;
    std::uint64_t count = 3;
    double rate = 10;
    std::string did;
};

SubCommand described(Values& values) {
    const SubCommand paint{.name = "paint",
                           .help = "Paints",
                           .options = {{"FILE", &values.file, "what"},
                                       {"--fast", &values.fast, "quickly"},
                                       {"-n,--name", &values.name, "its name", "NAME"},
                                       {"--text", &values.text, "may be empty", "TEXT"},
                                       {"--many", &values.many, "can be given again", "WORD"},
                                       {"--count", &values.count, "how many", "N", whole_number(1, 9, "9")},
                                       {"--rate", &values.rate, "how often", "HZ", number_from(4, 25)}},
                           .run = [&values] { return values.did = "painted", 7; },
                           .alias = "colour"};
    const SubCommand in{
        .name = "in", .help = "Inside", .options = {{"[DIR]", &values.file, "where"}}, .run = [&values] {
            return values.did = "in", 0;
        }};
    return {.name = "tool", .help = "A tool", .commands = {paint, {.name = "dig", .help = "Digs", .commands = {in}}}};
}

}  // namespace

TEST_CASE("typed values are stored as described, and all others keep their defaults", "[cli][command line]") {
    Values values;
    CHECK(run_command_line(described(values), {"paint", "wall", "--many", "a", "--many=b", "-n", "x", "--text", ""}) ==
          7);
    CHECK(values.did == "painted");
    CHECK(values.file == "wall");
    CHECK(values.name == "x");
    CHECK(values.text == "");
    CHECK(values.many == std::vector<std::string>{"a", "b"});
    CHECK_FALSE(values.fast);
    CHECK(values.count == 3);

    Values others;
    CHECK(run_command_line(described(others), {"colour", "--count", "9", "--many", "a", "b", "--fast", "--rate=4.5"}) ==
          7);
    CHECK(others.file == "b");
    CHECK(others.fast);
    CHECK(others.count == 9);
    CHECK(others.rate == 4.5);
    CHECK_FALSE(others.text);

    Values inner;
    CHECK(run_command_line(described(inner), {"dig", "in"}) == 0);
    CHECK(inner.did == "in");
}

TEST_CASE("nothing runs when a word is wrong", "[cli][command line]") {
    for (const std::vector<std::string>& words : {std::vector<std::string>{},
                                                  {"--"},
                                                  {"print"},
                                                  {"paint"},
                                                  {"paint", "wall", "more"},
                                                  {"paint", "wall", "--name", ""},
                                                  {"paint", "wall", "--many", ""},
                                                  {"paint", "wall", "--count", "0"},
                                                  {"paint", "wall", "--count", "1.5"},
                                                  {"paint", "wall", "--rate", "25.1"},
                                                  {"paint", "wall", "--rate", "nan"},
                                                  {"paint", "wall", "--rate", "5x"},
                                                  {"paint", "wall", "--fast", "--slow"},
                                                  {"dig"},
                                                  {"dig", "out"},
                                                  {"dig", "--deep"}}) {
        Values values;
        INFO((words.empty() ? "nothing" : words.back()));
        CHECK(run_command_line(described(values), words) == exit_could_not_run);
        CHECK(values.did.empty());
    }
}

TEST_CASE("an option accepts a value that begins with dashes and is not itself an option", "[cli][command line]") {
    const auto text = [](const std::vector<std::string>& words) {
        Values values;
        CHECK(run_command_line(described(values), words) == 7);
        return values.text;
    };
    CHECK(text({"paint", "w", "--text", "-1.5"}) == "-1.5");
    CHECK(text({"paint", "w", "--text", "-"}) == "-");
    CHECK(text({"paint", "w", "--text", "-- a comment"}) == "-- a comment");
    CHECK(text({"paint", "w", "--text=--odd"}) == "--odd");
    CHECK(text({"paint", "w", "--text=--fast"}) == "--fast");
}

TEST_CASE("every command's --help shows each option with its form, help and default", "[cli][command line]") {
    for (const SubCommand& command : {run_command(), attach_command(), calc_command(), types_command(), check_command(),
                                      new_command(), test_command()}) {
        INFO(command.name);
        const Outcome helped = run_nezumi({command.name, "--help"});
        CHECK(helped.status == 0);
        CHECK(helped.out.starts_with(command.help + "\nUsage: nezumi " + command.name));
        for (const Option& option : command.options) {
            INFO(option.name);
            const std::string name =
                option.name.substr(option.name.starts_with('[') ? 1 : 0, option.name.find(']') - 1);
            CHECK(helped.out.find("\n  " + name.substr(0, name.find(']')) +
                                  (option.form.empty() ? "" : " " + option.form)) != std::string::npos);
        }
        for (const SubCommand& below : command.commands)
            CHECK(helped.out.find("\n  " + below.name) != std::string::npos);
    }
    const std::string test = run_nezumi({"test", "--help"}).out;
    CHECK(test.find("-o,--output DIR=nezumi-test ") != std::string::npos);
    CHECK(test.find("repeat each run this many times (default 1);") != std::string::npos);
    CHECK(run_nezumi({"--version"}).out.starts_with("nezumi 0."));
}
