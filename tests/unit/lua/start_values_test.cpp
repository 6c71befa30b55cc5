// Values of parameters that are given at the start of a system.
#include "bindings/lua/files/start_values.hpp"

#include <catch2/catch.hpp>

#include "bindings/lua/files/system_file.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;
using namespace std::string_literals;

namespace {

struct ValueRig {
    ValueRig() {
        folder.write("behaviors/it.lua", "param('speed', 0.1)\nparam('name', 'a')\n");
        file = folder.write("system.lua",
                            "behavior 'it' { script = 'it', config = { speed = 0.2 },\n"
                            "  sets = { fast = { speed = 0.9 }, slow = { speed = 0.01 } }, set = 'fast' }\n"
                            "behavior 'other' { script = 'it' }\n");
    }
    // What 'it' has after these, or the error.
    Expected<BehaviorEntry> with(const StartValues& values) const {
        const Project project = Project::of(file, {});
        auto spec = read_system_file(file, project);
        if (!spec) return Unexpected(spec.error());
        if (auto ok = apply(values, *spec, project); !ok) return Unexpected(ok.error());
        return std::get<BehaviorEntry>(spec->entries.front());
    }
    Value value(const std::string& text) const { return with({.set = {"it.name=" + text}}).value().config.at("name"); }

    Scratch folder;
    std::filesystem::path file;
};

}  // namespace

TEST_CASE("a value is read as in Lua, and any other word is a text", "[lua][files]") {
    const ValueRig rig;
    CHECK(rig.value("30") == Value{std::int64_t{30}});
    CHECK(rig.value("-0.5") == Value{-0.5});
    CHECK(rig.value("true") == Value{true});
    CHECK(rig.value("fast") == Value{"fast"s});
    CHECK(rig.value("\"5\"") == Value{"5"s});
    CHECK(rig.value("a=b") == Value{"a=b"s});
    CHECK(rig.value("{ 1.0, 0.5 }") == Value{std::vector<double>{1.0, 0.5}});
    CHECK(rig.value("inf") == Value{"inf"s});
}

TEST_CASE("the last --set counts, before the file and the parameter set in use", "[lua][files]") {
    const ValueRig rig;
    const auto entry = rig.with({.set = {"it.speed=0.3", "it.speed=0.4"}});
    REQUIRE(entry);
    CHECK(entry->config.at("speed") == Value{0.4});
    CHECK(entry->sets.at("fast").at("speed") == Value{0.4});
    CHECK(entry->sets.at("slow").at("speed") == Value{0.01});
    CHECK(entry->places.at("config.speed").file == "--set it.speed=0.4");
}

TEST_CASE("a robot starts with the given value of its parameter", "[lua][files]") {
    const Scratch folder;
    const auto file = folder.write("system.lua",
                                   "robot 'ev' { model = 'ev3', mass = 0.7 }\nrobot 'mouse' { model = 'raspimouse' }\n"
                                   "robot 'other' { model = 'ev3' }\n");
    const auto saved = folder.write("saved.lua",
                                    "robot 'ev' { model = 'ev3', actuators = { medium_motor = { speed = 2.5 } } }\n"
                                    "robot 'gone' { model = 'ev3', actuators = { medium_motor = { speed = 2.5 } } }\n");
    const Project project = Project::of(file, {source_root()});
    const auto speed = [&](const StartValues& values, std::size_t robot) {
        auto spec = read_system_file(file, project).value();
        if (auto ok = apply(values, spec, project); !ok) return describe(ok.error());
        const auto& entry = std::get<RobotEntry>(spec.entries[robot]);
        const RobotSpec& description = spec.models.at(entry.described_by());
        CHECK((robot != 0 || description.mass == 0.7));
        for (const ActuatorSpec& actuator : description.actuators) {
            if (actuator.name == "medium_motor") return std::to_string(actuator.speed);
        }
        return "none"s;
    };
    CHECK(speed({.set = {"ev.medium_motor_speed=2"}}, 0) == "2.000000");
    CHECK(speed({.set = {"ev.medium_motor_speed=2"}}, 2) == "1.600000");
    CHECK(speed({.file = saved.string()}, 0) == "2.500000");
    CHECK(speed({.file = saved.string(), .set = {"ev.medium_motor_speed=3"}}, 0) == "3.000000");
    CHECK(speed({.set = {"ev.medium_motor_sped=2"}}, 0) ==
          "--set ev.medium_motor_sped=2: ev: unknown parameter 'medium_motor_sped' (did you mean "
          "'medium_motor_speed'?)");
    CHECK(speed({.set = {"ev.medium_motor_speed=99"}}, 0).find("is above its maximum") != std::string::npos);
    CHECK(speed({.set = {"mouse.speed=1"}}, 0) == "--set mouse.speed=1: mouse: this robot has no parameters");
}

TEST_CASE("parameters and parameter sets are set by --params, and --set comes before it", "[lua][files]") {
    const ValueRig rig;
    const std::string saved = rig.folder
                                  .write("saved.lua",
                                         "behavior 'it' { script = 'it', config = { speed = 0.6, name = 'b' } }\n"
                                         "behavior 'gone' { script = 'it' }\n")
                                  .string();
    const auto entry = rig.with({.file = saved, .set = {"it.name=c"}});
    REQUIRE(entry);
    CHECK(entry->config.at("speed") == Value{0.6});
    CHECK(entry->config.at("name") == Value{"c"s});
    CHECK(entry->set.empty());
    CHECK(entry->sets.empty());

    const std::string other =
        rig.folder.write("other.lua", "\nbehavior 'ohter' { script = 'it', config = { speed = 1 } }\n").string();
    const auto refused = rig.with({.file = other});
    REQUIRE_FALSE(refused);
    CHECK(refused.error().place.line == 2);
    CHECK(
        refused.error().message.ends_with(" has no behavior 'ohter' (did you mean 'other'?): --params needs a file "
                                          "that save has written for this system"));
}
