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

TEST_CASE("what is typed gets where the description says, the rest keeps its defaults", "[cli][command line]") {
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

TEST_CASE("a slip in the command line is one line with the nearest name", "[cli][command line]") {
    CHECK(run_nezumi({"new"}).error ==
          "nezumi: new: which? Write `nezumi new behavior NAME`, `nezumi new system NAME`, `nezumi new robot NAME`, "
          "`nezumi "
          "new scenario NAME` or `nezumi new project DIR`\n");
    CHECK(run_nezumi({"new", "--project", "x"}).error ==
          "nezumi: there is no option '--project'; see nezumi new --help\n");
    CHECK(run_nezumi({"calc", "--rate", "1"}).error ==
          "nezumi: --rate: expected a number from 4 to 25, got '1'; see nezumi calc --help\n");
    CHECK(run_nezumi({"test", "--filter", ""}).error ==
          "nezumi: --filter: expected a value, got ''; see nezumi test --help\n");
    CHECK(run_nezumi({"attach", "a", "b"}).error == "nezumi: 'b' is one word too many; see nezumi attach --help\n");
}

TEST_CASE("an option that is not known is said before what is missing", "[cli][command line]") {
    CHECK(run_nezumi({"run", "--headles"}).error ==
          "nezumi: there is no option '--headles' (did you mean '--headless'?); see nezumi run --help\n");
    for (const char* command : {"run", "check", "marker", "push", "completion", "manual"}) {
        CHECK(run_nezumi({command, "--hlep"}).error ==
              "nezumi: there is no option '--hlep' (did you mean '--help'?); see nezumi " + std::string(command) +
                  " --help\n");
    }
    CHECK(run_nezumi({"run"}).error == "nezumi: FILE is missing; see nezumi run --help\n");
}

TEST_CASE("an option is never taken for the value that was forgotten before it", "[cli][command line]") {
    const Scratch scratch;
    const auto said = [&](const std::vector<std::string>& words) {
        const Outcome outcome = run_nezumi(words, scratch.path("").string());
        CHECK(outcome.status == 2);
        CHECK(outcome.out.empty());
        CHECK(std::filesystem::is_empty(scratch.path("")));
        return outcome.error;
    };
    CHECK(said({"run", "x", "--record", "--trace-hash"}) ==
          "nezumi: --record: its value is missing (got the option --trace-hash); see nezumi run --help\n");
    CHECK(said({"run", "x", "--sounds", "--headless"}) ==
          "nezumi: --sounds: its value is missing (got the option --headless); see nezumi run --help\n");
    CHECK(said({"test", "-o", "--list"}) ==
          "nezumi: -o: its value is missing (got the option --list); see nezumi test --help\n");
    CHECK(said({"test", "--filter", "-o", "x"}) ==
          "nezumi: --filter: its value is missing (got the option -o); see nezumi test --help\n");
    CHECK(said({"attach", "--eval", "--list"}) ==
          "nezumi: --eval: its value is missing (got the option --list); see nezumi attach --help\n");
    CHECK(said({"new", "behavior", "b", "--in", "--out"}) ==
          "nezumi: --in: its value is missing (got the option --out); see nezumi new behavior --help\n");
    CHECK(said({"run", "x", "--record", "--odd"}) ==
          "nezumi: --record: its value is missing (got the option --odd); see nezumi run --help\n");
}

TEST_CASE("values that begin with dashes and are no options are taken", "[cli][command line]") {
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

TEST_CASE("a result is never written over a script, nor over what another option writes or reads",
          "[cli][command line]") {
    const Scratch scratch;
    scratch.write("g_test.lua", "-- mine\n");
    scratch.write("kept", "a journal\n");
    std::filesystem::create_symlink("g_test.lua", scratch.path("link.csv"));
    const auto said = [&](const std::vector<std::string>& words) {
        const Outcome outcome = run_nezumi(words, scratch.path("").string());
        CHECK(outcome.status == 2);
        CHECK(text_of_file(scratch.path("g_test.lua")) == "-- mine\n");
        CHECK(text_of_file(scratch.path("kept")) == "a journal\n");
        return outcome.error;
    };
    const auto script = [](const std::string& option, const std::string& file) {
        return "nezumi: " + option + ": '" + file +
               "' is a script's name, and a result would take its place: choose another ending\n";
    };
    for (const std::string option : {"--record", "--journal", "--device-log"}) {
        CHECK(said({"run", "x", option, "g_test.lua"}) == script(option, "g_test.lua"));
        CHECK(said({"run", "x", option, "new.lua"}) == script(option, "new.lua"));
        CHECK(said({"run", "x", option, "link.csv"}) == script(option, "link.csv"));
    }
    for (const std::string option : {"--junit", "--measures"})
        CHECK(said({"test", option, "g_test.lua"}) == script(option, "g_test.lua"));
    CHECK(said({"marker", "7", "-o", "g_test.lua"}) == script("--output", "g_test.lua"));

    CHECK(said({"run", "x", "--record", "same", "--journal", "./same"}) ==
          "nezumi: --record and --journal would write the same file, 'same': give each its own\n");
    CHECK(said({"run", "x", "--record", "a.svg", "--picture", "a.svg"}) ==
          "nezumi: --picture and --record would write the same file, 'a.svg': give each its own\n");
    CHECK(said({"test", "--junit", "X", "--measures", "X"}) ==
          "nezumi: --junit and --measures would write the same file, 'X': give each its own\n");
    CHECK(said({"run", "--replay", "kept", "--record", "kept", "x"}) ==
          "nezumi: --record would write over 'kept', which --replay reads: give it another file\n");
    CHECK_FALSE(std::filesystem::exists(scratch.path("same")));
}

TEST_CASE("two results may go to one device", "[cli][command line]") {
    const Outcome outcome = run_nezumi({"run", "behaviors/systems/stop_at_wall.lua", "--headless", "--speed", "max",
                                        "--duration", "0.1", "--record", "/dev/null", "--journal", "/dev/null"});
    CHECK(outcome.status == 0);
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
    CHECK(test.find("make each run so often (default 1);") != std::string::npos);
    CHECK(run_nezumi({"--version"}).out.starts_with("nezumi 0."));
}
