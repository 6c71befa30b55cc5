// The status line, as a terminal gets it, and the state as prompts and browsers get it.
#include <catch2/catch.hpp>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <regex>
#include <string>

#include "bindings/cli/run/console.hpp"
#include "tests/unit/cli/pty_program.hpp"

using namespace nezumi;
using namespace nezumi::cli;

namespace {

/// Runs the tutorial for a second on a terminal of this width; returns all that was written to it.
std::string on_terminal(unsigned short columns) {
    int terminal = -1;
    std::string program = nezumi_program();
    const pid_t child = fork_on_terminal(terminal, 24, columns);
    if (child == 0) {
        // Where nobody can type there is no prompt.
        dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
        execl(program.c_str(), "nezumi", "run", "behaviors/systems/stop_at_wall.lua", "--duration", "1",
              static_cast<char*>(nullptr));
        _exit(127);
    }
    std::string text;
    char buffer[4096];
    for (ssize_t count = 0; (count = read(terminal, buffer, sizeof buffer)) > 0;)
        text.append(buffer, static_cast<std::size_t>(count));
    close(terminal);
    int status = 0;
    waitpid(child, &status, 0);
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 0);
    return text;
}

/// What stands in the terminal's last line when `text` has been written up to `end`, without its colours.
std::string line_before(const std::string& text, std::size_t end) {
    std::string line;
    for (std::size_t i = text.find_last_of("\r\n", end - 1) + 1; i < end; ++i) {
        if (text[i] == '\x1b') {
            i = text.find_first_of("mJK", i);
        } else {
            line += text[i];
        }
    }
    return line;
}

/// Whether the text tells how late ticks begin: by half of them, by 99 of 100, and the worst, in this order of size.
bool tells_lateness(const std::string& text) {
    std::smatch found;
    const std::regex told("  late by p50 ([0-9.]+) ms, p99 ([0-9.]+) ms, worst ([0-9.]+) ms");
    if (!std::regex_search(text, found, told)) return false;
    const auto number = [&](std::size_t i) { return std::atof(found[i].str().c_str()); };
    return number(1) <= number(2) && number(2) <= number(3) && number(3) > 0;
}

}  // namespace

TEST_CASE("a terminal without a keyboard shows time, speed and states below the log, and cuts them at its width",
          "[cli][run]") {
    const std::string wide = on_terminal(100);
    const std::size_t last = wide.rfind("\r\x1b[J");
    REQUIRE(last != std::string::npos);
    const std::string line = line_before(wide, last);
    CHECK(line.find(" s  ") != std::string::npos);
    CHECK(line.find("x") != std::string::npos);
    CHECK(line.find("mouse ACTIVE  controller ACTIVE") != std::string::npos);

    const std::string narrow = on_terminal(20);
    std::size_t lines = 0;
    for (std::size_t at = narrow.find("\r\x1b[J", 1); at != std::string::npos; at = narrow.find("\r\x1b[J", at + 1)) {
        CHECK(line_before(narrow, at).size() <= 19);
        ++lines;
    }
    CHECK(lines >= 5);
}

TEST_CASE("a terminal shows how late ticks begin", "[cli][run]") {
    const std::string text = on_terminal(140);
    const std::string line = line_before(text, text.rfind("\r\x1b[J"));
    CAPTURE(line);
    CHECK(tells_lateness(line));
}

TEST_CASE("prompts and browsers show how late ticks begin, but nothing for a run without ticks", "[cli][run]") {
    auto live = RunningSystem::make(SystemSpec{}, Project::of("behaviors/systems/any.lua"), {});
    REQUIRE(live);
    RunLoop loop(**live, {});
    RunConsole console(loop, "tiny");
    std::vector<std::string> told;
    console.show_status_by([&](const std::string& text, bool) {
        told.push_back(text);
        if (told.size() == 2) loop.quit();
    });
    loop.add(console);
    loop.end_at(20);
    loop.run();
    REQUIRE(told.size() == 2);
    CHECK(told.front().find("late by") == std::string::npos);
    CAPTURE(told.back());
    CHECK(told.back().starts_with("tiny  1."));
    CHECK(tells_lateness(told.back()));
}
