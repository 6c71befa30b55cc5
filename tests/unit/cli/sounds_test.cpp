// What robots say, written by a run; and a floor that can't be read.
#include <catch2/catch.hpp>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;
namespace fs = std::filesystem;

namespace {

const std::string crier = R"lua(
local out = output("out", "TimedString", "what to say")
local said = false
function on_execute()
  if said then return end
  said = true
  out:write "tone,880,100"
  out:write "it's \"odd\"; $(touch pwned)"
end
)lua";

}  // namespace

TEST_CASE("a run writes what robots say into the folder that it is given", "[cli][run][sound]") {
    const Scratch scratch;
    scratch.write("behaviors/crier.lua", crier);
    const std::string file = scratch
                                 .write("system.lua", R"(
robot "ev3" { model = "ev3" }
behavior "crier" { script = "crier" }
connect("crier.out", "ev3.sound")
)")
                                 .string();
    const fs::path sounds = scratch.path("new/sounds");
    Program run({"run", file, "--headless", "--speed", "max", "--duration", "0.1", "--sounds", sounds.string()},
                scratch.path("").string());
    CHECK(run.wait() == 0);
    CHECK(fs::file_size(sounds / "ev3-0001.wav") == 44 + 2 * 2205);
    CHECK(fs::exists(sounds / "ev3-0002.txt"));
    CHECK_FALSE(fs::exists(scratch.path("pwned")));

    Program refused({"run", file, "--headless", "--duration", "0.1", "--sounds", file + "/x"});
    CHECK(refused.wait() == 2);
    CHECK(refused.error == "nezumi: '" + file + "/x' can't be made as a folder for sounds: Not a directory\n");
}

TEST_CASE("`run` and `check` report a picture of the floor that can't be read, with its line", "[cli][floor]") {
    const Scratch scratch;
    scratch.write("bad.png", "no picture");
    const std::string file =
        scratch.write("system.lua", "\narena { floor { image = \"bad.png\", size = { 1, 1 } } }\n").string();
    for (const std::string command : {"run", "check"}) {
        Program program({command, file});
        CHECK(program.wait() == (command == "run" ? 2 : 1));
        CHECK((program.error + program.out).find(":2: floor: ") != std::string::npos);
        CHECK((program.error + program.out).find("bad.png' can't be read as a PNG") != std::string::npos);
    }
}
