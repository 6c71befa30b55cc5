// Nothing that a run writes to can hold it: each row of the table in docs/reliability.md.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "engine/base/csv.hpp"
#include "tests/unit/cli/behavior_project.hpp"
#include "tests/unit/cli/pty_program.hpp"
#include "tests/unit/cli/sinks.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/source_root.hpp"
#include "tests/unit/web/raw_browser.hpp"

using namespace nezumi;

namespace {

using Clock = std::chrono::steady_clock;

// Says 10 kB in each tick, and has said that it begins.
const std::string talks = R"(
local out = output("out", "TimedLong")
local n = 0
function on_activated() log.info("begins") end
function on_execute()
  n = n + 1
  out:write(n)
  for i = 1, 10 do log.info(("x"):rep(1000)) end
end
)";
const std::string counts = R"(
local out = output("out", "TimedLong")
local n = 0
function on_activated() log.info("begins") end
function on_execute()
  n = n + 1
  out:write(n)
end
)";

// The system's time, asked by a console.
double now_of(pid_t process) {
    const Outcome seen = run_nezumi({"attach", std::to_string(process), "--eval", "return now()"});
    INFO(seen.error);
    REQUIRE(seen.status == 0);
    return std::atof(seen.out.c_str());
}

template <class Run>
void holds(const Sink& promised, Run& run) {
    INFO(promised.name);
    const double before = now_of(run.process());
    usleep(500'000);
    CHECK((now_of(run.process()) > before) == promised.ticks_go_on);
    run.send(SIGTERM);
    const auto begin = Clock::now();
    const auto status = run.wait_unread(30);
    const std::chrono::duration<double> took = Clock::now() - begin;
    CHECK(status == promised.status);
    CHECK(took.count() < (promised.ends_at_once ? 1.4 : 2.5));
    if (!promised.ends_at_once) CHECK(took.count() > 1.4);
}

// Where consoles look for a run whose home this is.
struct RuntimeFolder {
    explicit RuntimeFolder(const std::string& folder) { setenv("XDG_RUNTIME_DIR", folder.c_str(), 1); }
    ~RuntimeFolder() { unsetenv("XDG_RUNTIME_DIR"); }
};

// A FIFO that is full, with a reader that reads nothing.
struct Unread {
    explicit Unread(std::string fifo) : file(std::move(fifo)) {
        REQUIRE(mkfifo(file.c_str(), 0600) == 0);
        reader = open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
        writer = open(file.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
        while (write(writer, "x", 1) == 1) {
        }
    }
    ~Unread() {
        close(reader);
        close(writer);
    }
    const std::string file;
    int reader = -1, writer = -1;
};

std::vector<std::string> rows_of(const std::string& csv) {
    std::ifstream in(csv, std::ios::binary);
    std::vector<std::string> rows;
    for (std::string row; read_csv_row(in, row);) rows.push_back(row);
    return rows;
}

}  // namespace

TEST_CASE("a standard error that is not read holds no tick and no end, and its recording is whole",
          "[cli][ends][wallclock]") {
    const BehaviorProject project(talks);
    const std::string csv = project.scratch.path("it.csv").string();
    Program run({"run", project.file, "--no-web", "--record", csv});
    REQUIRE(run.wait_for_error("begins"));
    sleep(2);
    holds(sink("standard error: the log"), run);
    const auto rows = rows_of(csv);
    REQUIRE(rows.size() > 200);
    CHECK(rows.back().substr(rows.back().find(',') + 1) == std::to_string(rows.size() - 2));  // it ends in a last tick
}

TEST_CASE("lines that are left out of a log that is not read are counted, and reported when reading goes on",
          "[cli][ends][wallclock]") {
    const BehaviorProject project(talks);
    const std::string csv = project.scratch.path("it.csv").string();
    Program run({"run", project.file, "--headless", "--duration", "8", "--record", csv});
    REQUIRE(run.wait_for_error("begins"));
    sleep(6);
    REQUIRE(run.wait() == 0);
    const std::size_t logged = 10 * (rows_of(csv).size() - 1);
    std::size_t lines = 0;
    std::size_t lost = 0;
    std::istringstream said(run.error);
    for (std::string line; std::getline(said, line);) {
        if (line.ends_with("xxx")) ++lines;
        if (line.starts_with("(")) lost += static_cast<std::size_t>(std::atoi(line.c_str() + 1));
    }
    CHECK(lost > 100);
    CHECK(lines + lost >= logged);
    CHECK(lines + lost <= logged + 10);
    CHECK(run.error.find(" more lines were dropped, because they came too fast)\n") != std::string::npos);
}

TEST_CASE("a run without a clock waits for the reader of its log, which gets all lines", "[cli][ends][wallclock]") {
    const BehaviorProject project(talks);
    {
        Program run({"run", project.file, "--headless", "--speed", "max", "--duration", "10"});
        REQUIRE(run.wait_for_error("begins"));
        sleep(1);
        REQUIRE(run.wait() == 0);
        std::size_t lines = 0;
        for (std::size_t at = 0; (at = run.error.find("xxx\n", at)) != std::string::npos; ++at) ++lines;
        CHECK(lines == 10'000);
        CHECK(run.error.find("left out") == std::string::npos);
    }
    Program run({"run", project.file, "--headless", "--speed", "max"});
    REQUIRE(run.wait_for_error("begins"));
    sleep(1);
    holds(sink("standard error: the log of a run that does not follow a clock"), run);
}

TEST_CASE("a terminal with a status line that takes no output holds nothing", "[cli][ends][wallclock]") {
    const BehaviorProject project(talks);
    // Without a terminal as standard input there is no prompt.
    PtyProgram run({"run", project.file, "--no-web"}, project.scratch.path("").string(), 80, "/dev/null");
    const RuntimeFolder home(project.scratch.path("").string());
    REQUIRE(run.wait_until([&] { return run.screen.rows().size() > 20; }));
    run.stop_output();
    sleep(1);
    holds(sink("standard error: log and status line"), run);
}

TEST_CASE("a prompt whose terminal accepts no output blocks nothing, and the terminal is restored",
          "[cli][ends][wallclock]") {
    const BehaviorProject project(talks);
    PtyProgram run({"run", project.file, "--no-web"}, project.scratch.path("").string());
    const RuntimeFolder home(project.scratch.path("").string());
    REQUIRE(run.wait_until([&] { return run.screen.rows().size() > 20; }));
    run.stop_output();
    sleep(1);
    holds(sink("the prompt's terminal"), run);
    CHECK(run.is_as_before());
}

TEST_CASE("a standard output of --batch that is not read keeps no run from its end", "[cli][ends][wallclock]") {
    const BehaviorProject project(counts);
    const std::string commands =
        project.scratch.write("commands", "for i = 1, 10000 do print(('x'):rep(1000)) end\nrun(1000)\n").string();
    Program run({"run", project.file, "--batch"}, "", commands);
    REQUIRE(run.wait_for_output("xxx"));
    sleep(1);
    holds(sink("standard output of `--batch`"), run);
}

TEST_CASE("a file that takes nothing is given up, with a line", "[cli][ends][wallclock]") {
    const std::string option = GENERATE("record", "journal", "picture");
    const BehaviorProject project(counts, "behavior 'it' { script = 'it', rate = 200 }\nrate(200)\n");
    const Unread unread(project.scratch.path(option == "picture" ? "pipe.svg" : "pipe").string());
    Program run({"run", project.file, "--no-web", "--" + option, unread.file});
    REQUIRE(run.wait_for_error("begins"));
    sleep(1);
    holds(sink("`--" + option + "`"), run);
    run.wait();
    CHECK_THAT(run.error,
               Catch::Contains(option == "picture" ? "nezumi: 2 s after SIGTERM the run was still waiting for results "
                                                     "to be written, so it was ended by force\n"
                               : option == "journal"
                                   ? unread.file + ": the journal can't be written: it did not accept all data in time"
                                   : unread.file + ": can't be written: it did not accept all data in time"));
}

TEST_CASE("a file that takes less than comes ends the run with a line", "[cli][ends][wallclock]") {
    const BehaviorProject project(R"(
local out = output("out", "TimedString")
function on_activated() log.info("begins") end
function on_execute() out:write(("x"):rep(400000)) end
)");
    const Unread unread(project.scratch.path("pipe").string());
    Program run({"run", project.file, "--headless", "--record", unread.file});
    CHECK(run.wait() == 2);
    CHECK_THAT(run.error, Catch::Contains(unread.file +
                                          ": can't be written: it accepts data too slowly, and too much is waiting\n"));
}

TEST_CASE("a standard output that is full keeps no run from its end", "[cli][ends][wallclock]") {
    const BehaviorProject project(counts);
    const Unread full(project.scratch.path("pipe").string());
    Program run({"run", project.file, "--no-web", "--trace-hash"}, "", "", {.out = full.file});
    REQUIRE(run.wait_for_error("begins"));
    holds(sink("standard output: the trace hash"), run);
    run.wait();
    CHECK_THAT(run.error, Catch::Contains("was still waiting for standard output, so it was ended by force\n"));
}

TEST_CASE("a console writes only to files: a FIFO is refused at once", "[cli][ends][wallclock]") {
    const BehaviorProject project(counts);
    Program run({"run", project.file, "--no-web"});
    REQUIRE(run.wait_for_error("begins"));
    for (const auto& [command, ending] : {std::pair{"save", ".lua"}, {"picture", ".png"}, {"graph", ".svg"}}) {
        const std::string fifo = project.scratch.path(std::string("fifo") + ending).string();
        REQUIRE(mkfifo(fifo.c_str(), 0600) == 0);
        const Outcome tried =
            run_nezumi({"attach", std::to_string(run.process()), "--eval", fmt::format("{} '{}'", command, fifo)});
        CHECK(tried.status == 1);
        CHECK(tried.error == fmt::format("{}: '{}' is a FIFO: give another name\n", command, fifo));
    }
    for (const auto& entry : std::filesystem::directory_iterator(project.scratch.path("")))
        CHECK(entry.path().extension() != ".new");
    holds(sink("`save`, `picture` and `graph` of a console"), run);
}

TEST_CASE("an attached console that is stopped holds nothing", "[cli][ends][wallclock]") {
    const BehaviorProject project(talks);
    Program run({"run", project.file, "--no-web"}, "", "", {.error = "/dev/null"});
    std::optional<Program> attached;
    for (int tries = 0; tries < 100; ++tries) {
        attached.emplace(
            std::vector<std::string>{"attach", std::to_string(run.process()), "--eval", "print('there') run(1000)"});
        if (attached->wait_for_output("there", 5)) break;
        usleep(100'000);
    }
    attached->send(SIGSTOP);
    sleep(1);
    holds(sink("a console of `nezumi attach`"), run);
}

TEST_CASE("a browser that reads nothing holds nothing", "[cli][ends][wallclock]") {
    const BehaviorProject project(talks);
    Program run({"run", project.file});
    REQUIRE(run.wait_for_error("in a browser: "));
    const std::string address = run.error.substr(run.error.find("127.0.0.1:"));
    const int port = std::atoi(address.c_str() + 10);
    const std::string token = address.substr(address.find('#') + 1, 32);
    RawBrowser browser(
        port, [&] { run.listen(0.001); }, 4096);
    const std::string host = "127.0.0.1:" + std::to_string(port);
    REQUIRE(browser
                .ask("GET /ws HTTP/1.1\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
                     "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nHost: " +
                     host + "\r\nOrigin: http://" + host + "\r\nSec-WebSocket-Protocol: nezumi, token." + token +
                     "\r\n")
                .starts_with("HTTP/1.1 101"));
    run.listen(1);
    // Standard error is read on, or that would hold the end.
    const double before = now_of(run.process());
    run.listen(0.5);
    CHECK(now_of(run.process()) > before);
    run.send(SIGTERM);
    const auto begin = Clock::now();
    CHECK(run.wait() == sink("a browser").status);
    CHECK(Clock::now() - begin < std::chrono::milliseconds(1400));
}

TEST_CASE("a second signal ends a run at once that waits for its outputs", "[cli][ends][wallclock]") {
    const BehaviorProject project(talks);
    const std::string csv = project.scratch.path("it.csv").string();
    Program run({"run", project.file, "--no-web", "--record", csv});
    REQUIRE(run.wait_for_error("begins"));
    sleep(1);
    run.send(SIGTERM);
    usleep(300'000);
    const auto begin = Clock::now();
    run.send(SIGTERM);
    CHECK(run.wait_unread(30) == -SIGTERM);
    CHECK(Clock::now() - begin < std::chrono::milliseconds(1000));
    CHECK(rows_of(csv).size() > 90);
}

TEST_CASE("docs/reliability.md lists what happens when an output of a run accepts no data", "[cli][ends]") {
    std::string table =
        "| output | why it accepts no data | ticks meanwhile | after SIGTERM the run ends | status | lost data |\n"
        "|---|---|---|---|---|---|\n";
    for (const Sink& each : sinks)
        table += fmt::format("| {} | {} | {} | {} | {} | {} |\n", each.name, each.takes_nothing,
                             each.ticks_go_on ? "continue" : "wait", each.ends_at_once ? "at once" : "within 2 s",
                             each.status, each.lost);
    const std::string page = (root / "docs/reliability.md").string();
    const std::string text = text_of_file(page);
    const std::string begin = "<!-- sinks -->\n";
    const std::size_t from = text.find(begin), to = text.find("<!-- end sinks -->");
    REQUIRE(to != std::string::npos);
    const std::string renewed = text.substr(0, from + begin.size()) + table + text.substr(to);
    INFO("run this test with NEZUMI_RENEW=1 in the environment to bring the page up to date");
    CHECK(text == renewed);
    if (std::getenv("NEZUMI_RENEW") != nullptr) std::ofstream(page, std::ios::binary) << renewed;
}
