// What becomes of a recording when the disk gets full or the run ends at once, and of the older one of its name.
#include <catch2/catch.hpp>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <string>
#include <vector>

#include "bindings/cli/run/recorder.hpp"
#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/engine/try_component.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;

namespace {

const std::string stop_at_wall = "behaviors/systems/stop_at_wall.lua";

// A system of one behaviour.
struct RecordedProject {
    explicit RecordedProject(const std::string& behavior) {
        scratch.write("behaviors/it.lua", behavior);
        file = scratch.write("system.lua", "behavior \"it\" { script = \"it\" }\n").string();
    }
    Scratch scratch;
    std::string file;
};

}  // namespace

TEST_CASE("a disk that gets full costs no row that was whole, and not the older recording", "[cli][run]") {
    const Scratch scratch;
    const std::string csv = scratch.path("trace.csv").string(), said = scratch.path("said").string();
    const std::string command = "ulimit -f 40; exec " + nezumi_program() + " run " + stop_at_wall +
                                " --headless --speed max --duration 100 --ports mouse.truth.pose.position --record " +
                                csv + " 2>" + said;
    const std::string problem = csv + ": can't be written: File too large: complete rows are kept";
    const auto rows = [&] {
        auto lines = lines_of(text_of_file(csv));
        REQUIRE(lines.size() > 100);
        CHECK(lines.back() == "# the recording ends here: can't be written: File too large");
        lines.pop_back();
        for (const std::string& line : lines) CHECK(std::count(line.begin(), line.end(), ',') == 2);
        CHECK(text_of_file(csv).back() == '\n');
        return lines;
    };
    CHECK(WEXITSTATUS(std::system(command.c_str())) == 2);
    CHECK(text_of_file(said) == problem + "\n");
    const auto first = rows();
    const std::string older = text_of_file(csv);
    CHECK(WEXITSTATUS(std::system(command.c_str())) == 2);
    CHECK(text_of_file(said) == problem + ", and the previous file is now " + csv + "~\n");
    CHECK(rows() == first);
    CHECK(text_of_file(csv + "~") == older);
}

TEST_CASE("the time of a recording of real robots is the clock's, also after a stall", "[cli][run][hardware]") {
    const Scratch scratch;
    const std::string csv = scratch.path("trace.csv").string();
    double clock = 1000;
    System system({.rate = 100, .real_time = true, .clock = [&clock] { return clock; }}, nullptr);
    auto made = std::make_unique<TryComponent>("it");
    made->executed = [](TryComponent& self) -> Expected<void> {
        self.out.write(static_cast<std::int32_t>(self.executions()));
        return {};
    };
    REQUIRE((*system.add(std::move(made)))->activate(system.now()));
    Trace trace;
    trace.start(system);
    auto recorder = cli::Recorder::open(csv, trace, system, {"it.out"});
    REQUIRE(recorder);
    for (const double passed : {0.0, 0.25, 1.0, 0.125}) {
        clock += passed;
        system.tick();
        recorder->add_rows(system);
    }
    REQUIRE(recorder->finish());
    CHECK(text_of_file(csv) == "time,it.out\n0,1\n0.25,2\n1.25,3\n1.375,4\n");
}

TEST_CASE("a recording takes the place of the older one when it is whole", "[cli][run][watchdog]") {
    const Scratch scratch;
    const std::string csv = scratch.write("trace.csv", "of an earlier run\n").string();
    const auto record = [&](const std::string& file, const std::vector<std::string>& more) {
        std::vector<std::string> words{"run", file, "--headless", "--speed", "max", "--duration", "1", "--record", csv};
        words.insert(words.end(), more.begin(), more.end());
        return run_nezumi(words).status;
    };
    CHECK(record(stop_at_wall, {"--ports", "no.port"}) == 2);
    CHECK(text_of_file(csv) == "of an earlier run\n");
    const RecordedProject lost("function on_execute() if now() > 0.5 then while true do end end end\n");
    CHECK(record(lost.file, {}) == 2);  // no run: what there is of it says so, and the older one is kept
    CHECK(lines_of(text_of_file(csv)).back().starts_with("# the recording ends here: "));
    CHECK(text_of_file(csv + "~") == "of an earlier run\n");
    std::filesystem::remove(csv + "~");
    CHECK(record(stop_at_wall, {}) == 0);
    CHECK(lines_of(text_of_file(csv)).size() == 101);
    CHECK_FALSE(std::filesystem::exists(csv + "~"));
}

TEST_CASE("a second signal ends a run within a tick that does not end, and its recording is whole",
          "[cli][run][watchdog]") {
    const RecordedProject project(R"(
local out = output("out", "TimedLong")
local n = 0
function on_execute()
  n = n + 1
  out:write(n)
  if n == 100 then log.info("begins") while true do end end
end
)");
    const std::string csv = project.scratch.write("trace.csv", "time,of an earlier run\n").string();
    const int signal = GENERATE(SIGINT, SIGTERM, SIGHUP);
    Program program({"run", project.file, "--headless", "--speed", "max", "--record", csv});
    REQUIRE(program.wait_for_error("begins"));
    program.send(signal);
    usleep(100000);
    program.send(signal);
    CHECK(program.wait() == -signal);
    const auto lines = lines_of(text_of_file(csv));
    REQUIRE(lines.size() == 101);
    CHECK(lines[0] == "time,it.out");
    CHECK(lines[99] == "0.98,99");
    CHECK(lines[100] == "# the recording ends here: the run was ended immediately");
    CHECK(text_of_file(csv + "~") == "time,of an earlier run\n");
}
