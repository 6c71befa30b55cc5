// Whatever a behaviour does, the engine and everybody else go on: behaviours made at random, and those that once did
// harm.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <random>
#include <string>

#include "bindings/lua/files/system_file.hpp"
#include "bindings/lua/reload/lua_host.hpp"
#include "bindings/lua/sandbox/watchdog.hpp"
#include "bindings/lua/script/script_component.hpp"
#include "engine/live/running_system.hpp"
#include "engine/robot/robot.hpp"
#include "sim/world.hpp"
#include "tests/unit/environment.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/lua/machine_speed.hpp"
#include "tests/unit/lua/random_script.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;

namespace {

constexpr int ticks = 20;
constexpr int ticks_to_stand = 100;
constexpr int ticks_stood = 10;
constexpr Budget budget{0.02};
constexpr std::size_t most_memory = std::size_t{64} << 20;  // [bytes] of a behaviour
// What ticks may take when a behaviour has run out of its time: Lua's own code is left 0.05 s after that.
constexpr double most_of_a_tick = 1.5 * budget.seconds + 0.05;

const char* const bystander_system = R"(
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

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool is_sanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool is_sanitized = true;
#else
constexpr bool is_sanitized = false;
#endif
#else
constexpr bool is_sanitized = false;
#endif

struct End {
    bool loaded = false;
    bool failed = false;       // it went to ERROR
    bool out_of_time = false;  // then the rest depends on the machine
    std::uint64_t hash = 0;
    double slowest = 0;      // [s] CPU time of a tick
    std::size_t memory = 0;  // [bytes] at most, after a tick
    int acts = 0;            // that went well
};

// What somebody at the console does meanwhile; mostly nothing.
class Hands {
public:
    explicit Hands(std::uint64_t seed) : seed_(seed), random_(seed) {}

    bool act(RunningSystem& live) {
        switch (std::uniform_int_distribution<int>(0, 29)(random_)) {
            case 0: return done(live, Reload{.component = "it", .shown = "it.lua", .text = another()});
            case 1: return done(live, Reset{"it"});
            case 2: return done(live, Deactivate{"it"});
            case 3:
            case 4: return done(live, Activate{"it"});
            case 5:
            case 6: return done(live, Command{"it", "go", {.values = {std::int64_t{1}, std::string("b")}}});
            case 7: return done(live, Rollback{"it"});
            default: return false;
        }
    }

    /// A text that was loaded, or a command.
    bool has_run_out_of_time() const { return out_of_time_; }

private:
    bool done(RunningSystem& live, const Act& act) {
        const auto result = live.act(act, {});
        out_of_time_ = out_of_time_ || (!result && result.error().kind == Error::Kind::out_of_time);
        return result.has_value();
    }
    std::string another() { return RandomScript(seed_ + 1'000'000'007 * ++texts_).text(); }

    std::uint64_t seed_;
    std::uint64_t texts_ = 0;
    bool out_of_time_ = false;
    std::mt19937_64 random_;
};

// Runs behaviours beside another in a world with a robot, and looks at all but themselves.
class Trial {
public:
    Trial() {
        folder_.write("behaviors/bystander.lua", bystander_text);
        folder_.write("behaviors/part.lua", RandomScript::module());
        folder_.write("behaviors/it.lua", bystander_text);
        const std::filesystem::path file = folder_.write("system.lua", bystander_system);
        project_ = Project::of(file, {source_root()});
        spec_ = std::move(read_system_file(file, project_).value());
    }

    /// `seed` of what is done meanwhile; 0: nothing.
    End run(const std::string& script, std::uint64_t seed) const {
        folder_.write("behaviors/it.lua", script);
        LiveOptions options;
        options.scripts = &lua_scripts();
        options.world = sim::make_world;
        options.budget = budget;
        // A reload that runs out of its time is told in the log alone.
        bool is_told = false;
        options.build.log = [&](const LogLine& line) {
            is_told = is_told || line.text.find("ran for more than") != std::string::npos;
        };
        auto live = RunningSystem::make(spec_, project_, std::move(options));
        End end;
        if (!live) return end;
        end.loaded = true;
        (*live)->activate();
        const System& system = (*live)->system();
        const auto& it = dynamic_cast<const ScriptComponent&>(*system.find("it"));
        Hands hands(seed);
        for (int i = 0; i < ticks; ++i) {
            if (seed != 0) end.acts += hands.act(**live) ? 1 : 0;
            tick(**live, end);
            end.memory = std::max(end.memory, it.script().memory());
            end.out_of_time = end.out_of_time || it.out_of_time().has_value();
        }
        end.failed = it.state() == LifeState::error;
        end.hash = (*live)->trace_hash();
        (*live)->between_ticks();
        end.out_of_time = end.out_of_time || is_told || hands.has_run_out_of_time();
        const Component& bystander = *system.find("bystander");
        CHECK(bystander.state() == LifeState::active);
        CHECK(bystander.executions() == ticks);
        CHECK_FALSE(system.fatal_error());
        CHECK(end.memory <= most_memory);
        if (end.failed) check_stands(**live);
        return end;
    }

private:
    static void tick(RunningSystem& live, End& end) {
        const std::int64_t before = thread_time();
        live.tick();
        end.slowest = std::max(end.slowest, static_cast<double>(thread_time() - before) * 1e-9);
        const System& system = live.system();
        const Velocity2D velocity = system.robots().front()->guard().current();
        CHECK(std::isfinite(velocity.vx + velocity.va));
        CHECK(std::abs(velocity.vx) <= 1.5);
        CHECK(std::isfinite(system.world()->truth(0).pose.position.x));
    }

    // Soon, and from then on.
    static void check_stands(RunningSystem& live) {
        const System& system = live.system();
        const auto stands = [&] {
            return system.robots().front()->guard().current() == Velocity2D{} &&
                   std::abs(system.world()->truth(0).velocity.vx) < 0.01;
        };
        // On its way from one speed to another it stands for a moment, too.
        int stood = 0;
        for (int i = 0; i < ticks_to_stand && stood < ticks_stood; ++i) {
            live.tick();
            stood = stands() ? stood + 1 : 0;
        }
        CHECK(stood == ticks_stood);
    }

    Scratch folder_;
    Project project_;
    SystemSpec spec_;
};

}  // namespace

TEST_CASE("random behaviours do not disturb the engine, a stopped robot or other behaviours",
          "[lua][random][watchdog]") {
    const int count = number_from_environment("NEZUMI_SCRIPTS", 150);
    const int first = number_from_environment("NEZUMI_SEED", 1);
    const Trial trial;
    int loaded = 0;
    int failed = 0;
    int out_of_time = 0;
    int acts = 0;
    double slowest = 0;
    std::size_t memory = 0;
    for (int seed = first; seed < first + count; ++seed) {
        const auto number = static_cast<std::uint64_t>(seed);
        const std::string script = RandomScript(number).text();
        INFO("seed " << seed << ":\n" << script);
        const End one = trial.run(script, number);
        loaded += one.loaded ? 1 : 0;
        failed += one.failed ? 1 : 0;
        out_of_time += one.out_of_time ? 1 : 0;
        acts += one.acts;
        slowest = std::max(slowest, one.slowest);
        memory = std::max(memory, one.memory);
        // Sanitizers have times of their own; a machine that was busy for a moment is asked again.
        if (one.slowest > most_of_a_tick && !is_sanitized) {
            const double again = trial.run(script, number).slowest;
            CHECK(again <= most_of_a_tick * slowness());
        }
        if (!one.loaded || one.out_of_time) continue;
        const End other = trial.run(script, number);
        if (!other.out_of_time) CHECK(one.hash == other.hash);
    }
    // Otherwise the grammar tries nothing.
    CHECK(loaded > count * 9 / 10);
    CHECK(failed > count / 10);
    CHECK(failed < loaded);
    CHECK(acts > count);
    if (count > 150)
        WARN(count << " scripts from seed " << first << ": " << loaded << " loaded, " << failed << " ended in ERROR, "
                   << out_of_time << " ran out of time; " << acts << " acts, the slowest tick " << slowest * 1e3
                   << " ms, " << (memory >> 20) << " MB at most");
}

TEST_CASE("behaviours that once caused failures no longer do", "[lua][random][watchdog]") {
    const Trial trial;
    int count = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(source_root()) / "tests/fuzz/corpus/script")) {
        INFO(entry.path().string());
        CHECK(trial.run(text_of_file(entry.path()), 0).loaded);
        ++count;
    }
    CHECK(count >= 6);
}
