// What a system file is given from outside: arguments, calibrations of ROS; and what it is asked about.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/lua/system_reader.hpp"

using namespace nezumi;
using namespace nezumi::system_files;

TEST_CASE("a camera uses a calibration file of ROS", "[lua][system_file]") {
    const Scratch scratch;
    scratch.write("behaviors/ost.yaml",
                  "image_width: 320\nimage_height: 240\ncamera_matrix: {data: [300, 0, 160, 0, 301, 120, 0, 0, 1]}\n"
                  "distortion_model: plumb_bob\ndistortion_coefficients: {data: [0.1, 0.2, 0.3, 0.4, 0.5]}\n");
    const Project project = Project::of(scratch.path("s.lua"));
    const auto read = [&](const std::string& text) {
        return read_system_text(text, scratch.path("s.lua").string(), project);
    };
    const auto spec = read("component 'eye' { type = 'Camera', calibration = 'ost.yaml', config = { k1 = 0.0 } }");
    INFO((spec ? std::string() : describe(spec.error())));
    REQUIRE(spec.has_value());
    const auto& config = std::get<ComponentEntry>(spec->entries.at(0)).config;
    CHECK(config.at("width") == Value(std::int64_t{320}));
    CHECK(config.at("fy") == Value(301.0));
    CHECK(config.at("k3") == Value(0.5));
    CHECK(config.at("k1") == Value(0.0));  // as the file itself says
    CHECK(read("component 'eye' { type = 'Camera', calibration = 'ost.yaml', config = { width = 640 } }")
              .error()
              .message.find("was calibrated with width = 320") != std::string::npos);
    CHECK(read("component 'x' { type = 'LineDetector', calibration = 'ost.yaml' }").error().message ==
          "component 'x': calibration: is for a Camera, not for a LineDetector");
}

TEST_CASE("an argument of a system file has its default or the given value", "[lua][system_file]") {
    const Scratch scratch;
    scratch.write("behaviors/any.lua", "");
    const Project project = Project::of(scratch.path("s.lua"));
    const auto rate_of = [&](const std::string& text, std::vector<std::string> set) -> std::string {
        SystemFileOptions options;
        options.set = std::move(set);
        const auto spec = read_system_text(text, "s.lua", project, options);
        return spec ? fmt::format("{}", spec->rate) : describe(spec.error());
    };
    const std::string text = "rate(argument('n', 50, { min = 10, max = 100, doc = 'ticks' }))";
    CHECK(rate_of(text, {}) == "50");
    CHECK(rate_of(text, {"n=20", "x.y=1"}) == "20");
    CHECK(rate_of(text, {"n=5"}) == "--set n=5: argument 'n' (integer): 5 is below its minimum 10");
    CHECK(rate_of(text, {"n=fast"}).find("--set n=fast: argument 'n' (integer): expected integer, got string") == 0);
    CHECK(rate_of(text, {"m=5"}) == "--set m=5: s.lua has no argument 'm' (it has n)");
    CHECK(
        rate_of("rate(50)", {"m=5"}) ==
        "--set m=5: s.lua has no argument 'm': a parameter is COMPONENT.PARAMETER=VALUE, as in controller.speed_x=0.3");
    CHECK(rate_of("rate(argument(3, 50))", {}) ==
          "s.lua:1: argument: expected a name and a default, as in argument(\"n\", 5), got number");
}

TEST_CASE("an angle of more than a turn gives a note about degrees", "[lua][system_file]") {
    std::vector<std::string> notes;
    SystemFileOptions options;
    options.print = [&](std::string_view line) { notes.emplace_back(line); };
    const Project project = Project::of(root / "s.lua", {root});
    const auto read = [&](const std::string& text) {
        notes.clear();
        REQUIRE(read_system_text(text, "s.lua", project, options).has_value());
        return notes;
    };
    CHECK(read("robot 'mouse' { model = 'raspimouse',\n pose = { heading = 90 } }") ==
          std::vector<std::string>{"s.lua:2:11: robot 'mouse': field 'pose.heading' is 90 rad, more than a turn: were "
                                   "degrees meant? Write math.rad(90)"});
    CHECK(read("arena { box { at = { 1, 0, 0 }, size = { 1, 1, 1 }, yaw = -45 } }").size() == 1);
    CHECK(read("robot 'mouse' { model = 'raspimouse', pose = { heading = 6.28 } }").empty());
    CHECK(read("robot 'mouse' { model = 'raspimouse', pose = { heading = 31.4 } }").empty());
}
