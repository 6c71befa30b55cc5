// The status line, as a terminal gets it.
#include <catch2/catch.hpp>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <string>

#include "tests/unit/cli/pty_program.hpp"

using namespace nezumi;

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
