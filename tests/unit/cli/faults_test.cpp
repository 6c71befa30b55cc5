// Runs to which the system gives less than they ask for.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;

namespace {

std::string text_of_file(const std::string& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

}  // namespace

TEST_CASE("out of file descriptors, a run ends as any other or says in one line why there is none", "[cli][run]") {
    const Scratch scratch;
    const std::string csv = scratch.path("trace.csv").string(), said = scratch.path("said").string();
    int done = 0;
    int refused = 0;
    for (int most = 4; most < 20; ++most) {
        CAPTURE(most);
        // The shell needs descriptors of its own for what it redirects: before there are few.
        const std::string command = "exec 2>" + said + " </dev/null; ulimit -n " + std::to_string(most) +
                                    "; exec timeout -k 1 60 " + nezumi_program() +
                                    " run behaviors/systems/stop_at_wall.lua --duration 0.05 --record " + csv;
        const int status = WEXITSTATUS(std::system(command.c_str()));
        const std::string text = text_of_file(said);
        CAPTURE(text);
        if (status == 0) {
            ++done;
            CHECK(text_of_file(csv).find("\n0.04,") != std::string::npos);
        } else {
            ++refused;
            CHECK((status == 2 || status == 127));  // 127: no descriptor for a library that it is linked to
            CHECK(std::count(text.begin(), text.end(), '\n') == 1);
        }
        if (most == 19) CHECK(text.find("nobody can attach") == std::string::npos);
    }
    CHECK(done > 3);
    CHECK(refused > 0);
}
