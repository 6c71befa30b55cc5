// The prompt as a person uses it: a terminal, keys, and what stands on the screen.
#include <catch2/catch.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/unit/cli/pty_program.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;

namespace {

const std::string quiet = R"(
output("out", "TimedVelocity2D", "")
param("speed_x", 0.1, { min = 0.0, max = 1.5 })
param("speed_r", 0.0)
)";
const std::string chatty = R"(
state.count = 0
function on_execute()
  state.count = state.count + 1
  if state.count % 10 == 0 then log.info("line " .. state.count .. " of many") end
end
)";

struct Home {
    explicit Home(const std::string& behavior) {
        scratch.write("behaviors/it.lua", behavior);
        system = scratch.write("tiny.lua", "behavior \"controller\" { script = \"it\" }\n").string();
        home = scratch.path("home").string();
        std::filesystem::create_directory(home);
    }
    PtyProgram run(unsigned short columns = 80) const { return {{"run", system, "--no-web"}, home, columns}; }
    Scratch scratch;
    std::string system, home;
};

const std::string up = "\x1b[A";
const std::string left = "\x1b[D";
constexpr const char* ctrl_c = "\x03";
constexpr const char* ctrl_d = "\x04";

}  // namespace

TEST_CASE("at a terminal nezumi run is the prompt of its system, until Ctrl-D", "[cli][prompt]") {
    const Home home(quiet);
    PtyProgram it = home.run();
    REQUIRE(it.wait_for_row("tiny is running; help() shows the commands, Ctrl-D ends it"));
    REQUIRE(it.wait_for_prompt("nezumi>"));
    it.type("1 + 2\r");
    CHECK(it.wait_for_row("nezumi> 1 + 2"));
    CHECK(it.wait_for_row("3"));
    it.type("contoller.status\r");
    CHECK(it.wait_for_row("unknown name 'contoller' (did you mean 'controller'?)"));
    it.type("pause()\r");
    CHECK(it.wait_for_prompt("nezumi (paused)>"));
    it.type("run()\r");
    CHECK(it.wait_for_prompt("nezumi>"));
    it.type(ctrl_d);
    CHECK(it.wait() == 0);
    CHECK(it.is_as_before());
}

TEST_CASE("Tab completes what the live system has, and lists where there is a choice", "[cli][prompt]") {
    const Home home(quiet);
    PtyProgram it = home.run();
    REQUIRE(it.wait_for_prompt("nezumi>"));
    it.type("contr\t");
    CHECK(it.wait_for_prompt("nezumi> controller"));
    it.type(".config.sp\t");
    CHECK(it.wait_for_prompt("nezumi> controller.config.speed_"));
    it.type("\t");
    CHECK(it.wait_for_row("speed_r  speed_x"));
    CHECK(it.wait_for_prompt("nezumi> controller.config.speed_"));
    it.type("x\r");
    CHECK(it.wait_for_row("0.1"));
}

TEST_CASE("an input of several lines is typed or pasted, and run as one", "[cli][prompt]") {
    const Home home(quiet);
    PtyProgram it = home.run();
    REQUIRE(it.wait_for_prompt("nezumi>"));
    SECTION("typed") {
        it.type("for i = 1, 2 do\r");
        CHECK(it.wait_for_prompt("     >>"));
        it.type("print('round ' .. i)\rend\r");
    }
    SECTION("pasted by a terminal that says so") {
        it.type("\x1b[200~for i = 1, 2 do\r\tprint('round ' .. i)\rend\r\x1b[201~");
        CHECK(it.wait_for_prompt("end"));
        it.type("\r");
    }
    SECTION("pasted by a terminal that does not") { it.type("for i = 1, 2 do\n\tprint('round ' .. i)\nend\n"); }
    CHECK(it.wait_for_row("round 1"));
    CHECK(it.wait_for_row("round 2"));
    CHECK(it.wait_for_prompt("nezumi>"));
}

TEST_CASE("inputs are there again after a restart, those of several lines whole", "[cli][prompt]") {
    const Home home(quiet);
    {
        PtyProgram it = home.run();
        REQUIRE(it.wait_for_prompt("nezumi>"));
        it.type("'first'\r");
        CHECK(it.wait_for_row("\"first\""));
        it.type("for i = 1, 2 do\rprint('round ' .. i)\rend\r");
        CHECK(it.wait_for_row("round 2"));
        it.type(ctrl_d);
        CHECK(it.wait() == 0);
    }
    PtyProgram it = home.run();
    REQUIRE(it.wait_for_prompt("nezumi>"));
    it.type(up + "\r");
    CHECK(it.wait_for_row("round 2"));
    it.type(up + up);
    CHECK(it.wait_for_prompt("nezumi> 'first'"));
    it.type(left + left + "ly\r");
    CHECK(it.wait_for_row("\"firslyt\""));
}

TEST_CASE("log lines never break the input that is being typed", "[cli][prompt]") {
    const Home home(chatty);
    PtyProgram it = home.run();
    REQUIRE(it.wait_for_prompt("nezumi>"));
    const std::string text =
        "local greeting = 'a text that is longer than the terminal is wide, so that it takes two rows'";
    for (const char letter : text) {
        it.type(std::string(1, letter));
        it.wait_until([] { return false; }, 0.02);
    }
    it.type(left + left);
    REQUIRE(it.wait_until([&] { return it.screen.rows().size() > 15; }));
    it.type("!\r");
    REQUIRE(it.wait_until([&] { return it.screen.last_row() == "nezumi>"; }));

    // Every row is a whole log line, or the input in its two rows, once.
    const std::string input = "nezumi> " + text.substr(0, text.size() - 2) + "!" + text.substr(text.size() - 2);
    std::vector<std::string> others;
    int count = 0;
    for (const std::string& row : it.screen.rows()) {
        const std::string line = " of many";
        const bool is_log = row.starts_with("[ ") && row.ends_with(line) && row.find("info  controller: line ") == 12;
        if (is_log) {
            ++count;
        } else {
            others.push_back(row);
        }
    }
    CHECK(count > 10);
    CHECK(others == std::vector<std::string>{"tiny is running; help() shows the commands, Ctrl-D ends it",
                                             input.substr(0, 80), input.substr(80), "nezumi>"});
}

TEST_CASE("a long input is wrapped to the window's width, and log lines do not break it", "[cli][prompt]") {
    const Home home(chatty);
    PtyProgram it = home.run(55);
    REQUIRE(it.wait_for_prompt("nezumi>"));
    std::vector<std::string> expected{"tiny is running; help() shows the commands, Ctrl-D ends", " it"};
    const auto type = [&](std::size_t columns) {
        const std::string text = "'" + std::string(2 * columns, 'x') + "'";
        const std::size_t before = it.screen.rows().size();
        it.type(text);
        CHECK(it.wait_until([&] { return it.screen.rows().size() > before + 12; }));
        it.type(ctrl_c);
        CHECK(it.wait_until([&] { return it.screen.last_row() == "nezumi>"; }));
        const std::string input = "nezumi> " + text + "^C";
        for (std::size_t at = 0; at < input.size(); at += columns) expected.push_back(input.substr(at, columns));
    };
    type(55);
    it.resize(70);
    type(70);
    expected.push_back("nezumi>");

    std::vector<std::string> rows;
    for (const std::string& row : it.screen.rows()) {
        if (row.find("info  controller: line ") != 12) rows.push_back(row);
    }
    CHECK(rows == expected);
}

TEST_CASE("an input goes on in a window that was resized meanwhile", "[cli][prompt]") {
    const Home home(quiet);
    PtyProgram it = home.run(60);
    REQUIRE(it.wait_for_prompt("nezumi>"));
    const std::string text = "'" + std::string(40, 'x');
    it.type(text);
    CHECK(it.wait_until([&] { return it.screen.last_row() == "nezumi> " + text; }));
    it.resize(30);
    it.type("yz'");
    const std::string input = "nezumi> " + text + "yz'";
    CHECK(it.wait_until([&] {
        const auto& rows = it.screen.rows();
        return rows.size() > 2 && rows[rows.size() - 2] == input.substr(0, 30) && rows.back() == input.substr(30);
    }));
    it.resize(80);
    it.type("\x01");  // to its beginning
    it.type("\r");
    CHECK(it.wait_for_row(input));
}

TEST_CASE("the list that a Tab shows fits the window", "[cli][prompt]") {
    const Home home(quiet);
    PtyProgram it = home.run(17);
    REQUIRE(it.wait_for_prompt("nezumi>"));
    it.type("controller.config.sp\t\t");
    CHECK(it.wait_for_row("speed_r"));
    CHECK(it.wait_for_row("speed_x"));
}

TEST_CASE("Escape at the prompt costs no key, however late that comes", "[cli][prompt]") {
    const Home home(quiet);
    PtyProgram it = home.run();
    REQUIRE(it.wait_for_prompt("nezumi>"));
    it.type("\x1b");
    it.wait_until([] { return false; }, 0.3);
    it.type("12");
    CHECK(it.wait_for_prompt("nezumi> 12"));
    it.type("\x1b");
    it.wait_until([] { return false; }, 0.3);
    it.type(up + left);  // keys that begin with one are still known
    it.type("34\r");
    CHECK(it.wait_for_row("nezumi> 1342"));
    CHECK(it.wait_for_row("1342"));
}

TEST_CASE("Ctrl-C with nothing to drop says how to leave, and a second one soon after leaves", "[cli][prompt]") {
    const Home home(quiet);
    PtyProgram it = home.run();
    REQUIRE(it.wait_for_prompt("nezumi>"));
    it.type(ctrl_c);
    CHECK(it.wait_for_row("Ctrl-C again, or Ctrl-D, ends the run"));
    SECTION("an input in between") {
        it.type("1 + 1\r");
        CHECK(it.wait_for_row("2"));
        REQUIRE(it.wait_for_prompt("nezumi>"));  // before, Ctrl-C has an input to drop
        it.type(ctrl_c);
        CHECK(it.wait_for_row("Ctrl-C again, or Ctrl-D, ends the run"));
    }
    SECTION("too late") {
        it.wait_until([] { return false; }, 2.5);
        it.type(ctrl_c);
        CHECK(it.wait_for_row("Ctrl-C again, or Ctrl-D, ends the run"));
    }
    SECTION("in a console that is attached") {
        PtyProgram other({"attach"}, home.home);
        REQUIRE(other.wait_for_prompt("nezumi>"));
        other.type(ctrl_c);
        CHECK(other.wait_for_row("Ctrl-C again, or Ctrl-D, leaves; the system continues"));
        other.type(ctrl_c);
        CHECK(other.wait() == 0);
    }
    it.type("1 + 2\r");
    CHECK(it.wait_for_row("3"));
    REQUIRE(it.wait_for_prompt("nezumi>"));
    it.type(std::string(ctrl_c) + ctrl_c);
    CHECK(it.wait() == 0);
    CHECK(it.is_as_before());
}

TEST_CASE("exit leaves as quit() does", "[cli][prompt]") {
    const Home home(quiet);
    PtyProgram it = home.run();
    REQUIRE(it.wait_for_prompt("nezumi>"));
    it.type("exit\r");
    CHECK(it.wait() == 0);
    CHECK(it.is_as_before());
}

TEST_CASE("Ctrl-C drops the line that is typed and ends the one that runs; robots go on", "[cli][prompt][watchdog]") {
    const Home home(chatty);
    PtyProgram it = home.run();
    REQUIRE(it.wait_for_prompt("nezumi>"));
    it.type(std::string("print('not this')") + ctrl_c);
    CHECK(it.wait_for_row("nezumi> print('not this')^C"));
    it.type("while true do end\r");
    const auto rows = it.screen.rows().size();
    CHECK(it.wait_until([&] { return it.screen.rows().size() > rows + 5; }));
    it.type(ctrl_c);
    CHECK(it.wait_for_row("interrupted"));
    it.type("1 + 1\r");
    CHECK(it.wait_for_row("2"));
}

TEST_CASE("a loop without end is ended with a message, and no log line of a robot is late for it",
          "[cli][prompt][watchdog]") {
    const Home home(chatty);
    PtyProgram it = home.run();
    REQUIRE(it.wait_for_prompt("nezumi>"));
    it.type("before = controller.state.count while true do end\r");
    REQUIRE(it.wait_until(
        [&] {
            for (const std::string& row : it.screen.rows()) {
                if (row.find("5 s") != std::string::npos) return true;
            }
            return false;
        },
        60));
    // What 5 s of its own time take at 100 Hz, on a machine that is not quite free.
    it.type("controller.state.count - before > 400\r");
    CHECK(it.wait_for_row("true"));
}

TEST_CASE("arrow keys drive until Escape", "[cli][prompt]") {
    const Home home("local stick = input(\"stick\", \"TimedVelocity2D\", \"\")\n");
    PtyProgram it = home.run();
    REQUIRE(it.wait_for_prompt("nezumi>"));
    it.type("drive 'controller.stick'\r");
    REQUIRE(it.wait_until([&] { return it.screen.last_row().find("Esc ends") != std::string::npos; }));
    it.type(up);
    it.wait_until([] { return false; }, 0.3);
    it.type("\x1b");
    CHECK(it.wait_for_prompt("nezumi>"));
    it.type("controller.stick.tm > 0\r");
    CHECK(it.wait_for_row("true"));
}

TEST_CASE("what is typed while a seek computes is the next input", "[cli][prompt][past]") {
    const Home home("function on_execute() for i = 1, 60000 do end end\n");
    PtyProgram it = home.run();
    REQUIRE(it.wait_for_prompt("nezumi>"));
    it.type("speed \"max\" run(100) print('there')\r");
    REQUIRE(it.wait_until([&] { return it.screen.last_row().find("(paused)>") != std::string::npos; }, 60));
    it.type("seek(99)\r");
    REQUIRE(it.wait_until([&] { return it.screen.last_row().find("Esc cancels") != std::string::npos; }, 60));
    it.type("20 + 1");
    it.type(left + "2\r");
    CHECK(it.wait_for_row("41", 60));
    it.type("now()\r");
    CHECK(it.wait_for_row("99.0"));
    it.type("seek(98)\r");
    REQUIRE(it.wait_until([&] { return it.screen.last_row().find("Esc cancels") != std::string::npos; }, 60));
    it.type("7 * 6\x1b");
    it.wait_until([] { return false; }, 0.3);
    it.type("\r");
    CHECK(it.wait_for_row("42", 60));
    it.type("now()\r");
    CHECK(it.wait_for_row("99.0"));
    // A command without a keyboard gets the result alone.
    PtyProgram second({"attach", "--eval", "seek(97)"}, home.home);
    CHECK(second.wait_until(
        [&] { return second.screen.last_row().starts_with("at 97 s") || second.screen.rows().size() > 1; }, 60));
    CHECK(second.screen.rows().front().starts_with("at 97 s of main"));
}

TEST_CASE("a second terminal attaches and leaves, and the system goes on", "[cli][prompt][attach]") {
    const Home home(quiet);
    PtyProgram it = home.run();
    REQUIRE(it.wait_for_prompt("nezumi>"));
    {
        PtyProgram second({"attach"}, home.home);
        REQUIRE(second.wait_for_prompt("nezumi>"));
        second.type("controller.config.speed_x = 0.25\r");
        CHECK(second.wait_for_row("nezumi> controller.config.speed_x = 0.25"));
        second.type("controller.config.speed_x\r");
        CHECK(second.wait_for_row("0.25"));
        second.type(ctrl_d);
        CHECK(second.wait() == 0);
        CHECK(second.is_as_before());
    }
    it.type("controller.config.speed_x\r");
    CHECK(it.wait_for_row("0.25"));
    PtyProgram third({"attach", "tiny"}, home.home);
    REQUIRE(third.wait_for_prompt("nezumi>"));
    it.type("quit()\r");
    CHECK(it.wait() == 0);
    CHECK(third.wait_for_row("the system has ended"));
    CHECK(third.wait() == 0);
}

TEST_CASE("a terminal that goes away ends the run in good order, and an attached console alone",
          "[cli][prompt][watchdog]") {
    const Home home(quiet);
    PtyProgram it = home.run();
    REQUIRE(it.wait_for_prompt("nezumi>"));
    {
        PtyProgram second({"attach"}, home.home);
        REQUIRE(second.wait_for_prompt("nezumi>"));
        second.type("while true do end\r");
        second.hang_up();
    }
    it.type("1 + 1\r");
    CHECK(it.wait_for_row("2"));
    CHECK(it.hang_up() == 0);
}

TEST_CASE("a plot that is drawn again takes its own place, until something else is shown", "[cli][prompt]") {
    const Home home(quiet);
    PtyProgram it = home.run();
    REQUIRE(it.wait_for_prompt("nezumi>"));
    const auto drawn = [&] {
        const auto rows = it.screen.rows();
        return std::count(rows.begin(), rows.end(), "controller.config.speed_x");
    };
    it.type("plot('controller.config.speed_x', { every = 0.1 })\r");
    REQUIRE(it.wait_until([&] { return drawn() == 1; }));
    CHECK_FALSE(it.wait_until([&] { return drawn() > 1; }, 1));
    it.type("1 + 1\r");
    CHECK(it.wait_for_row("2"));
    CHECK(it.wait_until([&] { return drawn() == 2; }));
    it.type("unwatch()\r");
    CHECK(it.wait_for_prompt("nezumi>"));
}
