// What `nezumi check` finds in files, and which kind it takes a file for.
#include <catch2/catch.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/base/json_text.hpp"
#include "bindings/cli/files/check_files.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;
using namespace nezumi::cli;

TEST_CASE("a file's kind is decided by its words, then by its folder", "[cli][check]") {
    CHECK(kind_of_file("a.lua", "local p = input('in', 'TimedShort')") == LuaKind::behavior);
    CHECK(kind_of_file("a.lua", "function on_execute() end") == LuaKind::behavior);
    CHECK(kind_of_file("a.lua", "function on_exectue() end") == LuaKind::behavior);
    CHECK(kind_of_file("systems/a.lua", "local p = input('in', 'TimedShort')") == LuaKind::behavior);
    CHECK(kind_of_file("a.lua", "robot 'mouse' { model = 'raspimouse' }") == LuaKind::system);
    CHECK(kind_of_file("a.lua", "require 'lib.arena' {}") == LuaKind::behavior);
    CHECK(kind_of_file("systems/a.lua", "require 'lib.arena' {}") == LuaKind::system);
    CHECK(kind_of_file("a.lua", "return { twice = function(x) return 2 * x end }") == LuaKind::module);
    CHECK(kind_of_file("a.lua", "return function() robot('m', {}) end") == LuaKind::system_module);
    CHECK(kind_of_file("a.lua", "function on_execute() if true then return end end") == LuaKind::behavior);
    CHECK(kind_of_file("a.lua", "return robot_model {}") == LuaKind::robot);
    CHECK(kind_of_file("robots/a.lua", "return robot_modle {}") == LuaKind::robot);
    CHECK(kind_of_file("a_test.lua", "") == LuaKind::scenario);
    CHECK(kind_of_file("a.lua", "calibration { robot = 'm' }") == LuaKind::calibration);
    CHECK(kind_of_file("m.calibration.lua", "calibraton {}") == LuaKind::calibration);
    CHECK(kind_of_file("a.lua", "scenario('x', function() end)") == LuaKind::scenario);
    CHECK(kind_of_file("nezumi.lua", "---@meta\nfunction input() end") == LuaKind::definitions);
}

TEST_CASE("check finds no error in the shipped files", "[cli][check]") {
    const std::string root = source_root();
    const auto files = lua_files({root + "/behaviors", root + "/engine/robots"});
    REQUIRE(files.errors.empty());
    CHECK(files.files.size() >= 8);
    for (const auto& file : files.files) {
        const auto errors = check_file(file, simulated_systems());
        INFO((errors.empty() ? file.string() : describe(errors.front())));
        CHECK(errors.empty());
    }
}

TEST_CASE("systems are checked also where nothing can be simulated", "[cli][check]") {
    LiveOptions systems = simulated_systems();
    systems.world = nullptr;
    const std::string folder = source_root() + "/behaviors/systems/";
    for (const char* name : {"line_follower.lua", "leader_follower.lua"})
        CHECK(check_file(folder + name, systems).empty());
    const Scratch files;
    files.write("behaviors/systems/x.lua",
                "robot 'ev3' { model = 'ev3' }\nbehavior 'b' { script = 'errand' }\nconnect('ev3.touch', 'b.tuch')\n");
    const auto errors = check_file(files.path("behaviors/systems/x.lua"), systems);
    REQUIRE(errors.size() == 1);
    CHECK(errors.front().place.line == 3);
}

TEST_CASE("folders give their Lua files, sorted, once and without hidden ones", "[cli][check]") {
    const Scratch files;
    files.write("b.lua", "");
    files.write("a/c.lua", "");
    files.write("a/note.txt", "");
    files.write(".git/x.lua", "");
    const std::string root = files.path("").string();
    const auto found = lua_files({root, root + "b.lua"});
    REQUIRE(found.errors.empty());
    CHECK(found.files == std::vector<std::filesystem::path>{root + "a/c.lua", root + "b.lua"});

    const auto refused = [&](const std::string& path) {
        const auto result = lua_files({root + path});
        return result.errors.empty() ? std::string() : result.errors.front().message;
    };
    CHECK(refused("d.lua") == "there is no such file (did you mean '" + root + "b.lua'?)");
    CHECK(refused("a/note.txt") ==
          "is not a Lua file: `nezumi check` reads files that end in .lua, .msg or .idl, and folders");
    files.write("none/x.txt", "");
    CHECK(refused("none") == "has no Lua files");
}

TEST_CASE("texts with any bytes become JSON", "[cli][check]") {
    CHECK(json_text("a \"b\" \\ \n\t\x01") == R"("a \"b\" \\ \n\t\u0001")");
    CHECK(json_text("gr\xc3\xb6\xc3\x9f"
                    "e \xf0\x9f\x90\xad") ==
          "\"gr\xc3\xb6\xc3\x9f"
          "e \xf0\x9f\x90\xad\"");
    CHECK(json_text("\xff \xc3 \xed\xa0\x80") == "\"\ufffd \ufffd \ufffd\ufffd\ufffd\"");
}
