// `nezumi class`: what it collects and checks without a page, and what it refuses.
#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "bindings/web/classroom/confinement.hpp"
#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;

namespace {

namespace fs = std::filesystem;

// A class with pupils who have this exercise. Returns the work of the last one.
class Pupils {
public:
    fs::path add(const std::string& name, const std::string& exercise) {
        const std::string folder = "pupils/0" + std::to_string(++count_);
        scratch_.write(folder + "/pupil.json", R"({"name":")" + name + R"(","code":"abcdef","token":"t","exercise":")" +
                                                   exercise + R"(","mark":"A","comment":"good, go on","hints":[]})");
        fs::path work = scratch_.path(folder) / "work" / exercise;
        fs::create_directories(work.parent_path());
        fs::copy(fs::path(source_root()) / "behaviors/exercises" / exercise / "start", work,
                 fs::copy_options::recursive);
        return work;
    }
    fs::path path(const std::string& name) const { return scratch_.path(name); }
    Outcome collect() const {
        return run_nezumi({"class", scratch_.path().string(), "--collect", scratch_.path("results").string()});
    }

private:
    Scratch scratch_;
    int count_ = 0;
};

fs::path shipped(const std::string& name) { return fs::path(source_root()) / "behaviors" / name; }

}  // namespace

TEST_CASE("the work of a class is collected with results of shown and hidden scenarios", "[cli][class]") {
    if (!web::can_confine()) return;
    Pupils pupils;
    const fs::path good = pupils.add("花子", "part2_stop_at_wall");
    fs::copy_file(shipped("robot_controller.lua"), good / "behaviors/controller.lua",
                  fs::copy_options::overwrite_existing);
    pupils.add("Taro", "part2_stop_at_wall");
    const fs::path touch = pupils.add("Jiro", "part3_touch_drive");
    fs::copy_file(shipped("sample_touch_sensor.lua"), touch / "behaviors/driver.lua",
                  fs::copy_options::overwrite_existing);
    // A pupil's own scenarios do not count, and what a link leads to is not collected.
    fs::remove_all(touch / "tests");
    fs::create_directory_symlink(good, touch / "behaviors/of_others");
    const Outcome ended = pupils.collect();
    CHECK(ended.error.empty());
    REQUIRE(ended.status == 0);
    CHECK(text_of_file(pupils.path("results/results.csv")) ==
          "number,name,exercise,passed,scenarios,problem,mark,comment\n"
          "01,花子,part2_stop_at_wall,8,8,,A,\"good, go on\"\n"
          "02,Taro,part2_stop_at_wall,0,8,,A,\"good, go on\"\n"
          "03,Jiro,part3_touch_drive,3,3,,A,\"good, go on\"\n");
    CHECK(text_of_file(pupils.path("results/results.xml"))
              .find("<testsuite name=\"Taro\" tests=\"8\" failures=\"8\" errors=\"0\">") != std::string::npos);
    CHECK(fs::exists(pupils.path("results/01/part2_stop_at_wall/behaviors/controller.lua")));
    CHECK_FALSE(fs::exists(fs::symlink_status(pupils.path("results/03/part3_touch_drive/behaviors/of_others"))));
    CHECK_FALSE(fs::exists(pupils.path("checks/1")));
}

TEST_CASE("work that can't be checked is reported in the results", "[cli][class]") {
    if (!web::can_confine()) return;
    Pupils pupils;
    pupils.add("Hanako", "part3_touch_drive");
    const fs::path work = pupils.add("Taro", "part2_stop_at_wall");
    fs::remove_all(work);
    const Outcome ended = pupils.collect();
    CHECK(ended.status == 0);
    CHECK(text_of_file(pupils.path("results/results.csv"))
              .find("02,Taro,part2_stop_at_wall,0,0," + work.string() +
                    ": can't be copied: No such file or directory,") != std::string::npos);
}

TEST_CASE("a class without a folder, or at a wrong address, is refused in one line", "[cli][class]") {
    const Scratch scratch;
    const std::string file = scratch.write("file", "").string();
    CHECK(run_nezumi({"class", file + "/x"}).error == file + "/x: can't be made: Not a directory\n");
    CHECK(run_nezumi({"class", scratch.path().string(), "--listen", "here"}).error ==
          "nezumi: --listen: expected the IPv4 address at which others reach this computer, as in 192.168.1.20, got "
          "'here'\n");
}
