// What carries a camera stays until that is gone; what is recorded of a component that comes and goes.
#include <algorithm>
#include <catch2/catch.hpp>
#include <string>
#include <string_view>

#include "engine/base/csv.hpp"
#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;

namespace {

struct SmallRun {
    explicit SmallRun(const std::string& commands) {
        files.write("behaviors/it.lua",
                    "local out = output('out', 'TimedLong')\nlocal n = 0\n"
                    "function on_execute() n = n + 1 out:write(n) end\n");
        files.write("behaviors/systems/s.lua",
                    "robot 'mouse' { model = 'raspimouse' }\nbehavior 'it' { script = 'it' }\n"
                    "component 'camera' { type = 'Camera', on = 'mouse', at = { 0, 0, 0.05 } }\n");
        outcome = run_nezumi({"run", "s", "--batch", "--record", "r.csv", "--journal", "j", "--trace-hash"},
                             files.path("").string(), files.write("commands", commands).string());
    }

    Scratch files;
    Outcome outcome;
};

}  // namespace

TEST_CASE("a robot can't be removed before the camera that it carries", "[cli][act]") {
    const SmallRun it("remove 'mouse'\nremove 'camera'\nremove 'mouse'\nstep(2)\nls()\n");
    CHECK(it.outcome.error.find("remove: mouse carries camera: remove the carried component first") !=
          std::string::npos);
    CHECK(it.outcome.out.find("mouse") == std::string::npos);
}

TEST_CASE("a recording keeps empty columns of removed components, and has columns of added ones", "[cli][act]") {
    const SmallRun it("step(2)\nbehavior 'second' { script = 'it' }\nstep(2)\nremove 'it'\nstep(2)\n");
    const auto lines = lines_of(text_of_file(it.files.path("r.csv")));
    REQUIRE(lines.size() == 7);
    const auto column = [&](std::string_view name) {
        const auto names = *split_csv_row(lines[0]);
        const auto at = static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
        std::string cells;
        for (std::size_t row = 1; row < lines.size(); ++row) {
            const auto all = *split_csv_row(lines[row]);
            cells += (row > 1 ? "," : "") + (at < all.size() ? std::string(all[at]) : "none");
        }
        return cells;
    };
    CHECK(column("it.out") == "1,2,3,4,,");
    CHECK(column("second.out") == ",,1,2,3,4");
}

TEST_CASE("a run with added and removed entries replays to the same hash", "[cli][act]") {
    const SmallRun it(
        "step(2)\nbehavior 'second' { script = 'it' }\nmarker { name = 't', id = 3, at = { 1, 0, 0.1 } }\nstep(2)\n"
        "remove 't'\nremove 'it'\ndeactivate()\nactivate()\nstep(20)\n");
    CHECK(it.outcome.status == 0);
    const Outcome again = run_nezumi({"run", "s", "--replay", "j", "--trace-hash"}, it.files.path("").string());
    CHECK(again.status == 0);
    CHECK(again.out.find("trace hash: ") != std::string::npos);
    CHECK(it.outcome.out.find(again.out) != std::string::npos);
}
