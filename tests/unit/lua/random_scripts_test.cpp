// Whatever a behaviour does, the engine and everybody else go on: behaviours made at random, and those that once did
// harm.
#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

#include "bindings/lua/live/live_system.hpp"
#include "engine/robot/robot.hpp"
#include "sim/world.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/lua/random_script.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;

namespace {

constexpr int ticks = 20;
constexpr int ticks_to_stand = 100;
constexpr Budget budget{0.02};

const char* const system_text = R"(
robot    "mouse"    { model = "raspimouse" }
behavior "it"       { script = "it" }
behavior "bystander" { script = "bystander" }
connect("mouse.ir_sensor_out", "it.in")
connect("it.out", "mouse.target_velocity_in")
connect("mouse.ir_sensor_out", "bystander.in")
)";

const char* const bystander_text = R"(
local range = input("in", "TimedShortSeq")
local count = output("count", "TimedLong")
state.count = 0
function on_execute()
  assert(#range:read() == 4 and ("ab"):rep(2) == "abab")
  state.count = state.count + 1
  count:write(state.count)
end
)";

struct End {
    bool loaded = false;
    bool failed = false;       // it went to ERROR
    bool out_of_time = false;  // then the rest depends on the machine
    std::uint64_t hash = 0;
};

// Runs a behaviour beside another in a world with a robot, and looks at all but itself.
class Trial {
public:
    Trial() {
        folder_.write("behaviors/bystander.lua", bystander_text);
        file_ = folder_.write("system.lua", system_text);
    }

    End run(const std::string& script) const {
        folder_.write("behaviors/it.lua", script);
        LiveOptions options;
        options.installed = {source_root()};
        options.world = sim::make_world;
        options.budget = budget;
        options.build.log = [](const LogLine&) {};
        auto live = LiveSystem::load(file_, std::move(options));
        End end;
        if (!live) return end;
        end.loaded = true;
        (*live)->activate();
        const System& system = (*live)->system();
        const Component& it = *system.find("it");
        for (int i = 0; i < ticks; ++i) {
            (*live)->tick();
            const Robot& mouse = *system.robots().front();
            const Velocity2D velocity = mouse.guard().current();
            CHECK(std::isfinite(velocity.vx + velocity.va));
            CHECK(std::abs(velocity.vx) <= 1.5);
            CHECK(std::isfinite(system.world()->truth(0).pose.position.x));
        }
        end.failed = it.state() == LifeState::error;
        end.out_of_time = it.out_of_time().has_value();
        end.hash = (*live)->trace_hash();
        const Component& bystander = *system.find("bystander");
        CHECK(bystander.state() == LifeState::active);
        CHECK(bystander.executions() == ticks);
        CHECK_FALSE(system.fatal_error());
        if (end.failed) {
            for (int i = 0; i < ticks_to_stand; ++i) (*live)->tick();
            CHECK(system.robots().front()->guard().current() == Velocity2D{});
            CHECK(std::abs(system.world()->truth(0).velocity.vx) < 0.01);
        }
        return end;
    }

private:
    Scratch folder_;
    std::filesystem::path file_;
};

int count_from_environment(const char* name, int otherwise) {
    const char* text = std::getenv(name);
    return text != nullptr ? std::atoi(text) : otherwise;
}

}  // namespace

TEST_CASE("no behaviour made at random disturbs the engine, the robot's stand or another behaviour",
          "[lua][random][watchdog]") {
    const int count = count_from_environment("NEZUMI_SCRIPTS", 150);
    const int first = count_from_environment("NEZUMI_SEED", 1);
    const Trial trial;
    int loaded = 0;
    int failed = 0;
    int out_of_time = 0;
    for (int seed = first; seed < first + count; ++seed) {
        const std::string script = RandomScript(static_cast<std::uint64_t>(seed)).text();
        INFO("seed " << seed << ":\n" << script);
        const End one = trial.run(script);
        loaded += one.loaded ? 1 : 0;
        failed += one.failed ? 1 : 0;
        out_of_time += one.out_of_time ? 1 : 0;
        if (!one.loaded || one.out_of_time) continue;
        const End other = trial.run(script);
        if (!other.out_of_time) CHECK(one.hash == other.hash);
    }
    // Otherwise the grammar tries nothing.
    CHECK(loaded > count * 9 / 10);
    CHECK(failed > count / 10);
    CHECK(failed < loaded);
    if (count > 150)
        WARN(count << " scripts from seed " << first << ": " << loaded << " loaded, " << failed << " ended in ERROR, "
                   << out_of_time << " ran out of time");
}

TEST_CASE("behaviours that once did harm do none", "[lua][random][watchdog]") {
    const Trial trial;
    int count = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(source_root()) / "tests/fuzz/corpus/script")) {
        INFO(entry.path().string());
        CHECK(trial.run(text_of_file(entry.path())).loaded);
        ++count;
    }
    CHECK(count >= 6);
}
