// Behaviours from files, in a system, with modules that the project has.
#include "bindings/lua/script/behavior_maker.hpp"
#include "tests/unit/source_root.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

using namespace nezumi;

namespace {

namespace fs = std::filesystem;

struct MakerFolder {
    MakerFolder() { fs::create_directories(path / "behaviors" / "shared"); }
    ~MakerFolder() { fs::remove_all(path); }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(path / "behaviors" / name) << text;
    }

    fs::path path = fs::temp_directory_path() / ("nezumi_maker_" + std::to_string(::getpid()));
};

}  // namespace

TEST_CASE("the tutorial's controller drives until something is near", "[lua][behavior]") {
    const std::string root = source_root();
    SystemSpec spec;
    BehaviorEntry entry{
        .name = "controller", .script = "robot_controller", .path = root + "/behaviors/robot_controller.lua"};
    entry.config = {{"speed_x", 0.1}};
    spec.entries.emplace_back(entry);
    const BehaviorSettings settings{.project = Project::of(entry.path)};
    const Makers makers{
        .behavior = [&](const BehaviorEntry& e, const MakerContext& c) { return make_behavior(e, c, settings); }};
    auto system = build_system(spec, makers, {});
    REQUIRE(system);
    activate_all(**system, spec);
    Component& controller = *(*system)->find("controller");
    const auto driven = [&](std::int16_t right_front) {
        controller.find_in_port("in")->inject(std::vector<std::int16_t>{right_front, 0, 0, 0});
        (*system)->tick();
        return controller.find_out_port("out")->value().get<Velocity2D>();
    };
    CHECK(driven(30) == Velocity2D{.vx = 0.1});
    CHECK(driven(31) == Velocity2D{});
    CHECK(driven(30) == Velocity2D{.vx = 0.1});
    REQUIRE(controller.parameters().set("speed_x", -0.1));
    CHECK(driven(31) == Velocity2D{.vx = -0.1});  // backing away is never blocked
    CHECK(controller.type() == "RobotController");
}

TEST_CASE("modules are found beside the script and in the project", "[lua][behavior][modules]") {
    const MakerFolder folder;
    folder.write("main.lua",
                 "local m = require 'shared.numbers'\nlocal out = output('out', 'TimedLong')\n"
                 "function on_execute() out:write(m.answer) end");
    folder.write("shared/numbers.lua", "return { answer = 42 }");
    folder.write("lost.lua", "local m = require 'shared.nubmers'\nparam('x', 1)");
    const BehaviorSettings settings{.project = Project::of(folder.path / "behaviors" / "main.lua")};
    BehaviorEntry entry{.name = "main", .path = folder.path / "behaviors" / "main.lua"};
    auto component = make_behavior(entry, {}, settings);
    REQUIRE(component);
    REQUIRE((*component)->activate({}));
    (*component)->execute({});
    (*component)->latch_outputs({});
    CHECK((*component)->find_out_port("out")->value().get<std::int32_t>() == 42);

    entry.path = folder.path / "behaviors" / "lost.lua";
    const auto lost = make_behavior(entry, {}, settings);
    REQUIRE_FALSE(lost);
    CHECK(describe(lost.error()).find("/behaviors/lost.lua:1: require 'shared.nubmers': ") != std::string::npos);
    CHECK(describe(lost.error()).find("did you mean 'shared.numbers'?") != std::string::npos);
}

TEST_CASE("the top level reads the parameter set of the system file", "[lua][behavior]") {
    const MakerFolder folder;
    folder.write(
        "main.lua",
        "param('a', 1) param('b', 1) local a, b = config.a, config.b\nlocal out = output('out', 'TimedLongSeq')\n"
        "function on_execute() out:write { a, b } end");
    BehaviorEntry entry{.name = "main", .path = folder.path / "behaviors" / "main.lua"};
    entry.config = {{"a", std::int64_t{2}}, {"b", std::int64_t{2}}};
    entry.sets = {{"fast", {{"b", std::int64_t{3}}}}};
    entry.set = "fast";
    auto component = make_behavior(entry, {}, {.project = Project::of(entry.path)});
    REQUIRE(component);
    REQUIRE((*component)->activate({}));
    (*component)->execute({});
    (*component)->latch_outputs({});
    CHECK((*component)->find_out_port("out")->value().get<std::vector<std::int32_t>>() ==
          std::vector<std::int32_t>{2, 3});
}
