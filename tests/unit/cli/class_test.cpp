// `nezumi class`: what it collects and checks without a page, and what it refuses.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "bindings/web/classroom/confinement.hpp"
#include "tests/unit/cli/need_landlock.hpp"
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

// Runs the program where the kernel gives no random numbers.
Outcome run_without_random_numbers(const std::string& words) {
    if (access("/usr/bin/strace", X_OK) != 0) throw std::runtime_error("SKIPPED: strace is not installed");
    const Scratch scratch;
    const std::string out = scratch.path("out").string(), error = scratch.path("error").string();
    // The address sanitizer's search for leaks traces the process itself.
    const int status =
        std::system(("ASAN_OPTIONS=detect_leaks=0 "
                     "exec strace -f -qq -o /dev/null -e trace=getrandom -e inject=getrandom:error=ENOSYS " +
                     nezumi_program() + " " + words + " >" + out + " 2>" + error + " </dev/null")
                        .c_str());
    return {.status = WEXITSTATUS(status), .out = text_of_file(out), .error = text_of_file(error)};
}

fs::path shipped(const std::string& name) { return fs::path(source_root()) / "behaviors" / name; }

}  // namespace

TEST_CASE("the work of a class is collected with results of shown and hidden scenarios", "[cli][class]") {
    need_landlock();
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
    need_landlock();
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

TEST_CASE("scenarios of exercises, which fail until a pupil has solved them, run only where they are named",
          "[cli][class]") {
    const std::string root = source_root();
    const Outcome all = run_nezumi({"test", "--list", "--project", root});
    CHECK(all.status == 0);
    CHECK(all.out.find("robot_controller_test.lua") != std::string::npos);
    CHECK(all.out.find("exercises/") == std::string::npos);
    CHECK(run_nezumi({"list", "scenarios"}, root).out.find("exercises/") == std::string::npos);
    CHECK(run_nezumi({"test", "--list", "behaviors/exercises"}, root).out.find("exercises/part2_stop_at_wall/start/") !=
          std::string::npos);
}

TEST_CASE("a class without a folder, or at a wrong address, is refused in one line", "[cli][class]") {
    const Scratch scratch;
    const std::string file = scratch.write("file", "").string();
    CHECK(run_nezumi({"class", file + "/x"}).error == file + "/x: can't be made: Not a directory\n");
    CHECK(run_nezumi({"class", scratch.path().string(), "--listen", "here"}).error ==
          "nezumi: --listen: expected the IPv4 address at which others reach this computer, as in 192.168.1.20, got "
          "'here'\n");
}

TEST_CASE("without random numbers of the kernel no class begins, because its secrets could be guessed",
          "[cli][class]") {
    need_landlock();
    const Scratch scratch;
    const Outcome ended = run_without_random_numbers("class " + scratch.path("class").string());
    CHECK(ended.status == 2);
    CHECK(ended.error == "nezumi: can't get random numbers from the kernel for the secret in the class's address\n");
}

TEST_CASE("without random numbers of the kernel a run has no page, and is the same otherwise", "[cli][class]") {
    const Scratch scratch;
    const std::string file = scratch.write("s.lua", "robot 'mouse' { model = 'raspimouse', noise = 0.1 }\n").string();
    const Outcome paged = run_without_random_numbers("run " + file + " --duration 0.1");
    CHECK(paged.status == 0);
    CHECK(paged.error.find(
              "no page for browsers: the kernel gives no random numbers for the secret in the page's address\n") !=
          std::string::npos);
    // A pupil's program has no secret of its own, and its numbers come from the seed.
    const std::string run = "run " + file + " --headless --speed max --duration 1 --trace-hash";
    const std::string confined = web::can_confine() ? "confined " + scratch.path("").string() + " -- " : "";
    const Outcome without = run_without_random_numbers(confined + run);
    CHECK(without.status == 0);
    CHECK(without.out.starts_with("trace hash: "));
    CHECK(without.out ==
          run_nezumi({"run", file, "--headless", "--speed", "max", "--duration", "1", "--trace-hash"}).out);
}
