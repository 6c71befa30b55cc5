// Names that become files: the order of folders, and the message about a missing file.
#include "engine/project/project.hpp"

#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <fstream>

#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;
namespace fs = std::filesystem;

namespace {

std::string found(const Project& project, const Scratch& scratch, FileKind kind, std::string_view name,
                  const std::string& named_in) {
    const auto path = project.find(kind, name, scratch.path(named_in));
    if (!path) return describe(path.error());
    return path->lexically_relative(scratch.path("")).string();
}

}  // namespace

TEST_CASE("the project is the nearest folder above a file that has behaviors/", "[lua][project]") {
    const Scratch scratch;
    scratch.write("behaviors/a.lua", "");
    scratch.write("inner/behaviors/systems/deep/s.lua", "");
    scratch.write("outer/t.lua", "");
    CHECK(Project::of(scratch.path("inner/behaviors/systems/deep/s.lua")).root() == scratch.path("inner"));
    CHECK(Project::of(scratch.path("outer/t.lua")).root() == scratch.path("").parent_path());
    CHECK(Project::of(scratch.path("outer/not_there.lua")).root() == scratch.path("").parent_path());
}

TEST_CASE("a name is looked up beside the file, then in behaviors/, then among the installed ones", "[lua][project]") {
    const Scratch scratch;
    scratch.write("behaviors/systems/s.lua", "");
    scratch.write("share/behaviors/c.lua", "");
    scratch.write("share/engine/robots/c.lua", "");
    const Project project = Project::of(scratch.path("behaviors/systems/s.lua"), {scratch.path("share")});
    const std::string in = "behaviors/systems/s.lua";
    CHECK(found(project, scratch, FileKind::script, "c", in) == "share/behaviors/c.lua");
    CHECK(found(project, scratch, FileKind::model, "c", in) == "share/engine/robots/c.lua");
    scratch.write("behaviors/c.lua", "");
    CHECK(found(project, scratch, FileKind::script, "c", in) == "behaviors/c.lua");
    CHECK(found(project, scratch, FileKind::model, "c", in) == "behaviors/c.lua");
    scratch.write("behaviors/systems/c.lua", "");
    CHECK(found(project, scratch, FileKind::script, "c", in) == "behaviors/systems/c.lua");
}

TEST_CASE("a system may have the name of its behaviour", "[lua][project]") {
    const Scratch scratch;
    scratch.write("behaviors/systems/c.lua", "");
    scratch.write("behaviors/c.lua", "");
    const Project project = Project::of(scratch.path("behaviors/systems/c.lua"));
    CHECK(found(project, scratch, FileKind::script, "c", "behaviors/systems/c.lua") == "behaviors/c.lua");
    CHECK(found(project, scratch, FileKind::script, "c", "behaviors/systems/other.lua") == "behaviors/systems/c.lua");
}

TEST_CASE("the ending .lua may be omitted, and folders are part of a name", "[lua][project]") {
    const Scratch scratch;
    scratch.write("behaviors/systems/x.lua", "");
    scratch.write("behaviors/maps/room.csv", "");
    scratch.write("tests/t.lua", "");
    const Project project = Project::of(scratch.path("tests/t.lua"));
    CHECK(found(project, scratch, FileKind::system, "systems/x", "tests/t.lua") == "behaviors/systems/x.lua");
    CHECK(found(project, scratch, FileKind::system, "systems/x.lua", "tests/t.lua") == "behaviors/systems/x.lua");
    CHECK(found(project, scratch, FileKind::module, "systems.x", "tests/t.lua") == "behaviors/systems/x.lua");
    CHECK(found(project, scratch, FileKind::data, "maps/room.csv", "tests/t.lua") == "behaviors/maps/room.csv");
    CHECK(found(project, scratch, FileKind::script, "../behaviors/systems/x", "tests/t.lua") ==
          "behaviors/systems/x.lua");
    CHECK(found(project, scratch, FileKind::script, scratch.path("behaviors/systems/x.lua").string(), "tests/t.lua") ==
          "behaviors/systems/x.lua");
}

TEST_CASE("the error about an unknown name has the nearest name and all places", "[lua][project]") {
    const Scratch scratch;
    scratch.write("behaviors/robot_controller.lua", "");
    scratch.write("behaviors/systems/s.lua", "");
    const Project project = Project::of(scratch.path("behaviors/systems/s.lua"));
    const auto path = project.find(FileKind::script, "robot_controler", scratch.path("behaviors/systems/s.lua"));
    REQUIRE_FALSE(path.has_value());
    CHECK(describe(path.error()) ==
          "there is no script 'robot_controler' (did you mean 'robot_controller'?); looked for " +
              scratch.path("behaviors/systems/robot_controler.lua").string() + ", " +
              scratch.path("behaviors/robot_controler.lua").string());
    const std::string in = "behaviors/systems/s.lua";
    CHECK_THAT(found(project, scratch, FileKind::system, "system/s", in),
               Catch::StartsWith("there is no system file 'system/s'; "));
    CHECK_THAT(found(project, scratch, FileKind::system, "systems/t", in),
               Catch::Contains("(did you mean 'systems/s'?)"));
    CHECK_THAT(found(project, scratch, FileKind::system, "systems/t.lua", in),
               Catch::Contains("(did you mean 'systems/s.lua'?)"));
    CHECK(found(project, scratch, FileKind::script, "", in) == "the name of a script is empty");
    CHECK(found(project, scratch, FileKind::model, std::string_view("a\0b", 3), in) ==
          "the name of a robot model has a control character in it: 'a\\x00b'");
    CHECK(found(project, scratch, FileKind::module, "a\nb", in) ==
          "the name of a module has a control character in it: 'a\\x0ab'");
    CHECK(found(project, scratch, FileKind::script, "a\u202eb", in) ==
          "the name of a script has a control character in it: 'a\\u202eb'");
}

TEST_CASE("modules are found in behaviors/lib too, the project's own before the installed ones", "[lua][project]") {
    const Scratch scratch;
    scratch.write("behaviors/a.lua", "");
    scratch.write("share/behaviors/lib/nezumi/pid.lua", "");
    const Project project = Project::of(scratch.path("behaviors/a.lua"), {scratch.path("share")});
    const std::string in = "behaviors/a.lua";
    CHECK(found(project, scratch, FileKind::module, "nezumi.pid", in) == "share/behaviors/lib/nezumi/pid.lua");
    CHECK_THAT(found(project, scratch, FileKind::module, "nezumi.pdi", in),
               Catch::StartsWith("there is no module 'nezumi.pdi' (did you mean 'nezumi.pid'?); looked for "));
    CHECK_THAT(found(project, scratch, FileKind::script, "nezumi/pid", in), Catch::StartsWith("there is no script"));
    scratch.write("behaviors/lib/nezumi/pid.lua", "");
    const std::string own = "behaviors/lib/nezumi/pid.lua";
    CHECK(found(project, scratch, FileKind::module, "nezumi.pid", in) == own);
    CHECK(found(project, scratch, FileKind::module, "lib.nezumi.pid", in) == own);
    // A project's own can be made of the installed one.
    CHECK(found(project, scratch, FileKind::module, "nezumi.pid", own) == "share/behaviors/lib/nezumi/pid.lua");
    scratch.write("behaviors/nezumi/pid.lua", "");
    CHECK(found(project, scratch, FileKind::module, "nezumi.pid", in) == "behaviors/nezumi/pid.lua");
}

TEST_CASE("modules are only searched below the project's folders", "[lua][project]") {
    const Scratch scratch;
    scratch.write("behaviors/b.lua", "");
    scratch.write("outside.lua", "");
    const Project project = Project::of(scratch.path("behaviors/b.lua"));
    const std::string whole = scratch.path("outside").string();
    std::string dotted = whole;
    std::replace(dotted.begin(), dotted.end(), '/', '.');
    for (const std::string& name : {whole, dotted, std::string("..outside"), std::string("a..outside"),
                                    std::string("../outside"), std::string("lib."), std::string(".")}) {
        CHECK(found(project, scratch, FileKind::module, name, "behaviors/b.lua") ==
              "there is no module '" + shown(name) + "': expected names with dots between them, as in 'lib.pid'");
    }
}

TEST_CASE("a folder is not found as a file", "[lua][project]") {
    const Scratch scratch;
    scratch.write("behaviors/x.lua/y", "");
    CHECK_THAT(found(Project::of(scratch.path("a.lua")), scratch, FileKind::script, "x", "a.lua"),
               Catch::StartsWith("there is no script 'x'"));
}

TEST_CASE("files below the working directory are shown with relative paths, others with full paths", "[lua][project]") {
    const Project project = Project::of("behaviors/systems/s.lua");
    CHECK(project.shown("behaviors/./systems/../a.lua") == "behaviors/a.lua");
    CHECK(project.shown(fs::current_path() / "a.lua") == "a.lua");
    CHECK(project.shown("/nowhere/a.lua") == "/nowhere/a.lua");
    CHECK(project.shown("../a.lua") == (fs::current_path().parent_path() / "a.lua").string());
}

TEST_CASE("the error about a name that is not a file says what it is instead", "[lua][project]") {
    const Scratch scratch;
    fs::create_directories(scratch.path("behaviors/folder.lua"));
    REQUIRE(mkfifo(scratch.path("behaviors/pipe.lua").c_str(), 0600) == 0);
    const Project project = Project::of(scratch.path("a.lua"));
    const auto there = [&](const char* name) { return scratch.path("behaviors/").string() + name; };
    CHECK_THAT(found(project, scratch, FileKind::script, "pipe", "a.lua"),
               Catch::EndsWith("; " + there("pipe.lua") + " is a FIFO, expected a file"));
    CHECK_THAT(found(project, scratch, FileKind::script, "folder", "a.lua"), Catch::EndsWith(there("folder.lua")));
}

TEST_CASE("the name itself is not offered as the nearest name", "[lua][project]") {
    const Scratch scratch;
    scratch.write("behaviors/b.lua", "");
    scratch.write("behaviors/map.csv/x", "");
    const Project project = Project::of(scratch.path("behaviors/b.lua"));
    CHECK_THAT(found(project, scratch, FileKind::module, "b", "behaviors/b.lua"),
               Catch::StartsWith("there is no module 'b'; looked for"));
    CHECK_THAT(found(project, scratch, FileKind::data, "map.csv", "behaviors/b.lua"),
               Catch::StartsWith("there is no file 'map.csv'; looked for"));
}

TEST_CASE("updated results have no names for a folder that became empty or is gone", "[lua][project]") {
    const Scratch scratch;
    const fs::path folder = scratch.path("lib");
    scratch.write("lib/a.lua", "");
    const auto look = [&] {
        FileSnapshot files(disk());
        static_cast<void>(files.names_in(folder));
        return files.take().at(folder);
    };
    PathSeen seen = look();
    CHECK(seen.names == std::vector<std::string>{"a.lua"});
    fs::remove(folder / "a.lua");
    seen.update(look());
    CHECK(seen.what == "a folder");
    CHECK(seen.names == std::vector<std::string>());
    fs::remove_all(folder);
    seen.update(look());
    CHECK(seen.what.empty());
    CHECK_FALSE(seen.names);
}

TEST_CASE("a snapshot keeps the content of a file that is saved meanwhile", "[lua][project]") {
    const Scratch scratch;
    const std::string file = scratch.write("a.lua", "first").string();
    FileSnapshot files(disk());
    CHECK(files.read(file, "a.lua") == "first");
    CHECK(files.what_is(scratch.path("b.lua")).empty());
    CHECK(describe(files.read(scratch.path("b.lua"), "b.lua").error()) == "b.lua: there is no such file");
    scratch.write("a.lua", "second");
    scratch.write("b.lua", "new");
    CHECK(files.read(file, "a.lua") == "first");
    CHECK(files.what_is(scratch.path("b.lua")).empty());
    CHECK_FALSE(files.read(scratch.path("b.lua"), "b.lua"));
    CHECK(FileSnapshot(disk()).read(file, "a.lua") == "second");
    CHECK(FileSnapshot(disk(), files.take()).read(file, "a.lua") == "first");
}
