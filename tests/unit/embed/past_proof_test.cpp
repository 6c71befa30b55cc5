// The proof that going back is exact: random acts, seeks and branches, and the hash of every tick that is come to
// again.
//
// NEZUMI_SEEKS: how many seeks, 60 without it; NEZUMI_SEEK_TICKS: the length of runs, 400 without it.
#include <catch2/catch.hpp>

#include <cstdlib>
#include <iterator>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <tuple>

#include "bindings/embed/simulation.hpp"
#include "engine/live/running_system.hpp"
#include "tests/unit/environment.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;

namespace {

const Actor prover{Actor::Kind::console, ""};

// Shared tables, tasks in the middle of a wait, random numbers, a delayed detector's results, a noisy robot.
std::string wanderer(unsigned variant) {
    return R"(
local range = input("in", "TimedShortSeq", "distances")
local seen = input("seen", "TimedBoolean", "whether a marker was in sight")
local target = output("out", "TimedVelocity2D", "velocity")
param("speed", 0.1, { min = -1, max = 1 })
state.a = state.a or { 0 }
state.b, state.steps = state.b or state.a, state.steps or 0
command("kick", function() state.a[1] = state.a[1] + 100 end, "")
task("patrol", function()
  wait(0.37)
  state.steps = state.steps + )" +
           std::to_string(variant) + R"(
  wait_until(function() return (range:read()[1] or 0) > 20 or seen:read() end, { within = 0.21 })
end, { repeating = true })
function on_execute()
  state.a[1] = state.a[1] + 1
  local turn = math.random() - 0.5 + state.b[1] * 1e-4 + state.steps * 1e-3
  if seen:is_new() and seen:read() then turn = -turn end
  target:write { vx = config.speed, va = turn + (range:read()[1] or 0) * 1e-5 }
end
)";
}

std::string proof_system(bool has_camera) {
    std::string text = R"(
arena { size = { 3, 3 }, box { at = { 0.8, 0.0, 0.15 }, size = { 0.1, 1.0, 0.3 }, mass = 0.5 },
        marker { name = "target", id = 7, size = 0.1, at = { 0.6, 0.7, 0.06 }, facing = math.pi } }
for i = 1, 2 do
  robot("mouse_" .. i, { model = "raspimouse", noise = 0.05, pose = { x = 0, y = i - 1.5, heading = 0 } })
  behavior("wanderer_" .. i, { script = "wanderer", sets = { fast = { speed = 0.3 } } })
  connect("mouse_" .. i .. ".ir_sensor_out", "wanderer_" .. i .. ".in")
  connect("wanderer_" .. i .. ".out", "mouse_" .. i .. ".target_velocity_in")
end
)";
    if (has_camera)
        text += R"(
component "eye" { type = "Camera", on = "mouse_2", at = { 0.05, 0.0, 0.06 },
                  config = { width = 160, height = 120, frame_rate = 5, latency = 0.13, noise = 3 } }
component "detector" { type = "MarkerDetector", config = { tag_size = 0.1, latency = 0.17 } }
connect("eye.out", "detector.image")
connect("detector.visible", "wanderer_2.seen")
)";
    return text;
}

class Proof {
public:
    Proof(unsigned seed, int threads, bool has_camera) : random_(seed) {
        folder_.write("behaviors/wanderer.lua", wanderer(1));
        LiveOptions options = simulated_systems({source_root()});
        options.build.threads = threads;
        options.budget = headless_budget;
        auto loaded = RunningSystem::load(folder_.write("system.lua", proof_system(has_camera)), std::move(options));
        if (!loaded) FAIL(describe(loaded.error()));
        live_ = std::move(*loaded);
        live_->activate();
        see();
    }

    void run_ticks(int count) {
        for (; count > 0; --count) {
            live_->tick();
            see();
        }
    }

    void act_at_random() {
        const std::string name = "wanderer_" + std::to_string(1 + below(2));
        switch (below(9)) {
            case 0:
            case 1: return act(SetParameter{name, "speed", 0.01 * static_cast<double>(below(60)) - 0.1});
            case 2:
            case 3: return act(Command{name, "kick", {}});
            case 4: return act(Teleport{"mouse_1", {{-0.01 * static_cast<double>(below(100)), -0.9}, 1.0}});
            case 5: return act(Use{name, "fast"});
            case 6: return act(MoveThing{"box 1", {{0.8 + 0.001 * static_cast<double>(below(200)), 0.2}, 0.1}});
            case 7: folder_.write("behaviors/wanderer.lua", wanderer(below(5))); return act(Reload{});
            default: return below(5) == 0 ? act(Restart{}) : act(Press{"mouse_1", "switch0", below(2) == 0});
        }
    }

    // To any tick of any branch and start that there was, and on from there.
    void seek_at_random() {
        auto known = seen_.begin();
        std::advance(known, below(static_cast<unsigned>(seen_.size())));
        const auto& [branch, start, tick] = known->first;
        INFO("branch " << branch << ", start " << start << ", tick " << tick);
        const auto done = live_->act(Seek{live_->history().branches()[branch].name, tick, start}, prover);
        INFO((done ? "" : describe(done.error())));
        REQUIRE(done);
        REQUIRE(live_->trace_hash() == known->second);
        run_ticks(static_cast<int>(below(20)));
        REQUIRE_FALSE(live_->differs());
    }

    unsigned below(unsigned end) { return std::uniform_int_distribution<unsigned>(0, end - 1)(random_); }
    std::int64_t now() const { return live_->when().tick; }
    std::size_t ticks() const { return seen_.size(); }
    std::size_t branches() const { return live_->history().branches().size(); }

private:
    void act(const Act& act) {
        const auto done = live_->act(act, prover);
        INFO((done ? "" : describe(done.error())));
        // A place may be taken by the other robot.
        if (!std::holds_alternative<Teleport>(act) && !std::holds_alternative<MoveThing>(act)) CHECK(done);
    }
    void see() {
        const ActTime now = live_->when();
        const auto [known, is_new] =
            seen_.try_emplace({live_->history().current(), now.start, now.tick}, live_->trace_hash());
        if (known->second != live_->trace_hash())
            FAIL_CHECK("tick " << now.tick << " of start " << now.start << " is another one than before");
    }

    Scratch folder_;
    std::mt19937 random_;
    std::unique_ptr<RunningSystem> live_;
    std::map<std::tuple<std::size_t, int, std::int64_t>, std::uint64_t> seen_;
};

}  // namespace

TEST_CASE("a tick that is computed again is the same: saves, restarts, waits, shared tables, noise, detectors, threads",
          "[embed][past][proof]") {
    const int seeks = number_from_environment("NEZUMI_SEEKS", 60),
              longest = number_from_environment("NEZUMI_SEEK_TICKS", 400);
    int done = 0;
    std::size_t ticks = 0, branches = 0;
    for (unsigned seed = 1; done < seeks; ++seed) {
        INFO("seed " << seed);
        Proof proof(seed, seed % 2 == 0 ? 2 : 1, seed % 3 == 0);
        for (int i = 0; i < 20 && done < seeks; ++i, ++done) {
            for (unsigned acts = proof.below(4); acts > 0; --acts) {
                if (proof.now() < longest)
                    proof.run_ticks(static_cast<int>(proof.below(static_cast<unsigned>(longest) / 4)));
                proof.act_at_random();
            }
            proof.seek_at_random();
        }
        ticks += proof.ticks();
        branches += proof.branches();
    }
    if (std::getenv("NEZUMI_SEEKS") != nullptr)
        WARN(done << " seeks among " << ticks << " ticks of " << branches << " branches");
}
