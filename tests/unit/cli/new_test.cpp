// What `nezumi new` writes, and what it refuses to.
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/files/check_files.hpp"
#include "bindings/cli/new/files.hpp"
#include "bindings/cli/new/project.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;
using namespace nezumi::cli;

TEST_CASE("new files are written all or none, and nothing is overwritten", "[cli][new]") {
    const Scratch files;
    files.write("b.lua", "mine");
    const auto refused = write_new_files({{files.path("new/a.lua"), "a"}, {files.path("b.lua"), "b"}});
    REQUIRE_FALSE(refused.has_value());
    CHECK(refused.error().place.file == files.path("b.lua"));
    CHECK(refused.error().message == "exists already, and nothing is overwritten: choose another name or move it away");
    CHECK(text_of_file(files.path("b.lua")) == "mine");
    CHECK_FALSE(std::filesystem::exists(files.path("new")));

    // A file where a folder is needed shows itself only when the first one is written already.
    const auto half = write_new_files({{files.path("new/a.lua"), "a"}, {files.path("b.lua/c.lua"), "c"}});
    CHECK_FALSE(half.has_value());
    CHECK_FALSE(std::filesystem::exists(files.path("new")));

    CHECK(write_new_files({{files.path("new/deep/a.lua"), "a"}}).has_value());
    CHECK(text_of_file(files.path("new/deep/a.lua")) == "a");
}

TEST_CASE("a new project passes nezumi check and its robot explores without touching anything", "[cli][new]") {
    const Scratch folder;
    for (const NewFile& file : project_files("mine")) folder.write(file.path.string(), file.text);
    const auto files = lua_files({folder.path("").string()});
    REQUIRE(files.errors.empty());
    CHECK(files.files.size() == 3);
    for (const auto& file : files.files) CHECK(check_file(file, simulated_systems()).empty());
    CHECK(text_of_file(folder.path("README.md")).find("# mine\n") == 0);

    auto live = RunningSystem::load(folder.path("behaviors/systems/room.lua"), simulated_systems());
    REQUIRE(live.has_value());
    (*live)->activate();
    const System& system = (*live)->system();
    double path = 0;
    for (int tick = 0; tick < 6000; ++tick) {
        (*live)->tick();
        path += std::abs(system.world()->truth(system.find_robot("mouse")->id()).velocity.vx) * 0.01;
        REQUIRE_FALSE(system.world()->collided(0));
    }
    CHECK(path > 3);
}
