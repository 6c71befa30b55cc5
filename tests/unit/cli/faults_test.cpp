// Runs to which the system gives less than they ask for.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;

TEST_CASE("out of file descriptors, a run ends as any other or says in one line why there is none", "[cli][run]") {
    const Scratch scratch;
    const std::string csv = scratch.path("trace.csv").string(), said = scratch.path("said").string();
    int done = 0;
    int refused = 0;
    int alone = 0;
    for (int most = 3; most < 25; ++most) {
        CAPTURE(most);
        const std::string command =
            "exec prlimit --nofile=" + std::to_string(most) + " timeout -k 1 60 " + nezumi_program() +
            " run behaviors/systems/stop_at_wall.lua --duration 0.05 --record " + csv + " 2>" + said + " </dev/null";
        const int status = WEXITSTATUS(std::system(command.c_str()));
        const std::string text = text_of_file(said);
        CAPTURE(text);
        if (status == 0) {
            ++done;
            alone += text.find("no console can attach: ") == 0 ? 1 : 0;
            CHECK(text_of_file(csv).find("\n0.04,") != std::string::npos);
        } else {
            ++refused;
            CHECK((status == 2 || status == 127));  // 127: no descriptor for a library that it is linked to
            CHECK(std::count(text.begin(), text.end(), '\n') == 1);
        }
    }
    CHECK(done > 3);
    CHECK(alone > 0);
    CHECK(alone < done);
    CHECK(refused > 0);
}
