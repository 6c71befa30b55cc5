// Which file a behaviour's `script` means.
#include "bindings/lua/files/find_script.hpp"

#include <catch2/catch.hpp>
#include <map>
#include <string>

#include "bindings/lua/files/system_file.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;

namespace {

namespace fs = std::filesystem;

constexpr const char* behavior_text =
    "local out = output('out', 'TimedLong')\nfunction on_execute() out:write(1) end\n";
constexpr const char* system_text = "arena { size = { x = 2, y = 2 } }\nbehavior 'f' { script = 'foo' }\n";

struct Files : Scratch {
    // Where a system in behaviors/systems/ finds this script, or why it does not.
    std::string found(std::string_view name) const {
        const Project project = Project::of(path("behaviors/systems/bar.lua"), {path("share")});
        const auto file = find_script(project, name, path("behaviors/systems/bar.lua"));
        return without_folder(file ? file->string() : describe(file.error()));
    }
    std::string without_folder(std::string text) const {
        const std::string folder = path("").string();
        for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder))
            text.erase(at, folder.size());
        return text;
    }
};

}  // namespace

TEST_CASE("a behaviour is found even if a system beside the file has its name", "[lua][project]") {
    const Files files;
    files.write("behaviors/foo.lua", behavior_text);
    for (const char* const system : {system_text, "require 'lib.room' { mice = 3 }", "local n = 3\nrobot('m', {})"}) {
        files.write("behaviors/systems/foo.lua", system);
        CHECK(files.found("foo") == "behaviors/foo.lua");
        CHECK(files.found("foo.lua") == "behaviors/foo.lua");
    }
    files.write("share/behaviors/own.lua", behavior_text);
    files.write("behaviors/own.lua", system_text);
    files.write("behaviors/systems/own.lua", system_text);
    CHECK(files.found("own") == "share/behaviors/own.lua");
}

TEST_CASE("a behaviour beside the file comes first, also a broken or an empty one", "[lua][project]") {
    const Files files;
    files.write("behaviors/foo.lua", behavior_text);
    for (const char* const beside :
         {behavior_text, "", "function on_execute( end", "robot = 3 function on_execute() end", "param('x', 1) robot()",
          "local m = require 'lib.m' m.declare(input, output)",
          "local n = 0 local function go() map, line = rate, marker n = n + 1 end task('go', go)"}) {
        files.write("behaviors/systems/foo.lua", beside);
        INFO(beside);
        CHECK(files.found("foo") == "behaviors/systems/foo.lua");
    }
}

TEST_CASE("the error for a script whose name only a system has says so", "[lua][project][refusals]") {
    const Files files;
    files.write("behaviors/systems/foo.lua", system_text);
    CHECK(files.found("foo") ==
          "there is no script 'foo'; looked for behaviors/systems/foo.lua, behaviors/foo.lua, "
          "share/behaviors/foo.lua; behaviors/systems/foo.lua is a system file, not a behaviour: `nezumi new behavior` "
          "makes one, in behaviors/");
    files.write("share/behaviors/foo.lua", system_text);
    CHECK(files.found("foo") ==
          "there is no script 'foo'; looked for behaviors/systems/foo.lua, behaviors/foo.lua, "
          "share/behaviors/foo.lua; behaviors/systems/foo.lua, share/behaviors/foo.lua are system files, not "
          "behaviours: `nezumi new behavior` makes one, in behaviors/");
    const std::string bar = files.path("behaviors/systems/bar.lua").string();
    const auto spec = read_system_text("rate(50)\nbehavior 'f' {\n  script = 'foo' }", bar, Project::of(bar));
    REQUIRE_FALSE(spec);
    CHECK_THAT(
        files.without_folder(describe(spec.error())),
        Catch::StartsWith("behaviors/systems/bar.lua:3:3: behavior 'f': there is no script 'foo'; looked for "
                          "behaviors/systems/foo.lua, behaviors/foo.lua; behaviors/systems/foo.lua is a system file"));
}

TEST_CASE("the script of many behaviours is read once to find it", "[lua][project]") {
    struct CountingFiles final : ProjectFiles {
        fs::path working_folder() const override { return disk().working_folder(); }
        std::string what_is(const fs::path& path) const override { return disk().what_is(path); }
        std::vector<std::string> names_in(const fs::path& folder) const override { return disk().names_in(folder); }
        Expected<std::string> read(const fs::path& path, const std::string& shown) const override {
            ++reads[path.filename().string()];
            return disk().read(path, shown);
        }
        mutable std::map<std::string, int> reads;
    };
    const Files files;
    files.write("behaviors/systems/foo.lua", system_text);
    files.write("behaviors/foo.lua", behavior_text);
    const CountingFiles counting;
    const std::string bar = files.path("behaviors/systems/bar.lua").string();
    const auto spec = read_system_text("for i = 1, 100 do behavior('f' .. i, { script = 'foo' }) end", bar,
                                       Project::of(bar, {}, counting));
    REQUIRE(spec);
    CHECK(spec->entries.size() == 100);
    CHECK(counting.reads == std::map<std::string, int>{{"foo.lua", 2}});
}
