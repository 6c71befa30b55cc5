// A run in which everything that can be done to a system is done at random, journaled.
#pragma once

#include <catch2/catch.hpp>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "bindings/journal/journal.hpp"
#include "bindings/journal/replay.hpp"
#include "bindings/lua/reload/lua_host.hpp"
#include "engine/devices/joystick.hpp"
#include "engine/live/running_system.hpp"
#include "sim/world.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/source_root.hpp"

namespace nezumi {

inline const char* const journal_version = "test";

class RandomRun {
public:
    explicit RandomRun(std::uint64_t seed) : seed_(seed), random_(seed) {
        write_scripts(0);
        file = folder.write("system.lua", system);
    }

    /// Acts now and then, for so many ticks, and returns the hash. `after_tick` may end it.
    std::uint64_t run(int ticks, const std::function<bool(Journal&)>& after_tick = {}) {
        auto made = Journal::create(journal_file());
        REQUIRE(made);
        Journal& journal = **made;
        LiveOptions options = makers();
        options.build.seed = seed_;
        auto loaded = RunningSystem::load(file, std::move(options));
        if (!loaded) FAIL(describe(loaded.error()));
        live_ = std::move(*loaded);
        journal.begin(*live_, journal_version, false);
        live_->activate();
        for (int i = 0; i < ticks; ++i) {
            if (random_() % 20 == 0) act();
            live_->tick();
            see();
            ++ticks_;
            if (i % 500 == 0) journal.mark();
            journal.serve();
            if (after_tick && !after_tick(journal)) break;
        }
        journal.end(RunEnd::duration, "", live_->when(), live_->trace_hash());
        CHECK_FALSE(journal.error());
        return live_->trace_hash();
    }

    /// The names of the acts that went well.
    std::set<std::string_view> done;
    Scratch folder;
    std::filesystem::path file;
    std::filesystem::path journal_file() const { return folder.path("run.journal"); }

    static LiveOptions makers() {
        LiveOptions options;
        options.scripts = &lua_scripts();
        options.installed = {source_root()};
        options.world = sim::make_world;
        options.components = {{"Joystick", {{"sim", make_joystick}}}};
        options.budget = headless_budget;
        return options;
    }

private:
    static constexpr const char* system = R"(
arena { size = { 4, 4 }, box { at = { 1.0, 0.3, 0.15 }, size = { 0.1, 1.0, 0.3 }, mass = 0.5 },
        marker { name = "target", id = 7, size = 0.1, at = { 1.5, 0, 0.1 }, facing = math.pi } }
robot     "mouse"      { model = "raspimouse" }
behavior  "controller" { script = "wanderer", sets = { fast = { speed = 0.5 }, slow = { speed = 0.125 } } }
component "stick"      { type = "Joystick" }
connect("mouse.ir_sensor_out", "controller.range")
connect("controller.out", "mouse.target_velocity_in")
)";

    void write_scripts(std::uint64_t variant) const {
        folder.write("behaviors/step.lua", "return { step = " + std::to_string(variant % 5) + " }");
        folder.write("behaviors/wanderer.lua", R"(
local steps = require "step"
local range = input("range", "TimedShortSeq", "walls")
local target = output("out", "TimedVelocity2D", "velocity")
param("speed", 0.25, { min = -1.5, max = 1.5 })
param("gains", { 1.0, 0.5 })
state.count = state.count or 0
command("add", function(a, b) state.count = state.count + (a or 0) return state.count, b end, "counts up")
command("fail", function() error("no luck") end)
function on_execute()
  state.count = state.count + steps.step
  local near = 0
  for _, value in ipairs(range:read()) do near = math.max(near, value) end
  if state.count % 1000 == 999 then error("now and then") end
  target:write { vx = near > 30 and -config.speed or config.speed, va = math.random() - 0.5 + )" +
                                                   std::to_string(variant % 3) + " }\nend\n");
    }

    std::uint64_t below(std::uint64_t end) { return random_() % end; }
    double number() { return static_cast<double>(below(2001)) / 1000 - 1; }
    template <class T>
    T one_of(std::initializer_list<T> all) {
        return *(all.begin() + static_cast<std::ptrdiff_t>(below(all.size())));
    }
    std::string component() { return one_of<std::string>({"controller", "controller", "mouse", "stick", "extra"}); }
    std::string velocity_port() { return one_of<std::string>({"controller.out", "mouse.target_velocity_in"}); }
    Velocity2D velocity() { return {.vx = number() / 2, .va = number()}; }

    // One for every kind of act: a new kind does not compile before it has one.
    Act make(std::in_place_type_t<SetParameter>) {
        if (below(4) == 0) return SetParameter{"controller", "gains", std::vector<double>{number(), number()}};
        return SetParameter{"controller", "speed", number()};
    }
    Act make(std::in_place_type_t<Write>) { return Write{"controller.out", velocity()}; }
    Act make(std::in_place_type_t<Inject>) {
        return Inject{"controller.range", std::vector<std::int16_t>{static_cast<std::int16_t>(below(100)), 0}};
    }
    Act make(std::in_place_type_t<Hold>) { return Hold{velocity_port(), velocity(), below(2) == 0}; }
    Act make(std::in_place_type_t<Release>) {
        return Release{one_of<std::string>({velocity_port(), "controller.range"})};
    }
    Act make(std::in_place_type_t<Drop>) { return Drop{velocity_port()}; }
    Act make(std::in_place_type_t<Freeze>) { return Freeze{"controller.range"}; }
    Act make(std::in_place_type_t<Activate>) { return Activate{component()}; }
    Act make(std::in_place_type_t<Deactivate>) { return Deactivate{component()}; }
    Act make(std::in_place_type_t<Reset>) { return Reset{component()}; }
    Act make(std::in_place_type_t<Use>) { return Use{"controller", one_of<std::string>({"fast", "slow", "none"})}; }
    Act make(std::in_place_type_t<Connect>) {
        return below(2) == 0 ? Act{Connect{"controller.out", "mouse.target_velocity_in"}}
                             : Act{Connect{"mouse.ir_sensor_out", "controller.range"}};
    }
    Act make(std::in_place_type_t<Disconnect>) {
        return Disconnect{"controller.out", one_of<std::string>({"", "mouse.target_velocity_in"})};
    }
    Act make(std::in_place_type_t<Teleport>) { return Teleport{"mouse", {{number(), number()}, number() * 3}}; }
    Act make(std::in_place_type_t<MoveMarker>) { return MoveMarker{"target", {{number(), number(), 0.1}, {}}}; }
    Act make(std::in_place_type_t<MoveThing>) {
        return MoveThing{one_of<std::string>({"box 1", "wall", "box 2"}), {{number(), number()}, number()}};
    }
    Act make(std::in_place_type_t<AddMarker>) {
        return AddMarker{
            {.name = "sign", .id = 5, .size = 0.1, .at = {number(), number(), 0.1}, .place = {file.string(), 1}}};
    }
    Act make(std::in_place_type_t<RemoveMarker>) { return RemoveMarker{"sign"}; }
    Act make(std::in_place_type_t<Disturb>) {
        Disturb disturbance{"mouse"};
        if (below(2) == 0) disturbance.vx = number() / 4;
        return disturbance;
    }
    Act make(std::in_place_type_t<Press>) {
        return Press{"mouse", one_of<std::string>({"switch0", "switch1", "switch2"}), below(2) == 0};
    }
    Act make(std::in_place_type_t<Command>) {
        if (below(4) == 0) return Command{"controller", "fail", {}};
        PlainData data;
        data.values = {static_cast<std::int64_t>(below(10)), TableRef{0}};
        data.tables = {{{std::int64_t{1}, number()}, {std::string("\xff text"), TableRef{0}}}};
        return Command{"controller", "add", data};
    }
    Act make(std::in_place_type_t<Reload>) {
        write_scripts(random_());
        if (below(5) == 0)
            return Reload{.component = "controller", .shown = "broken.lua", .text = "function on_execute( end"};
        return Reload{};
    }
    Act make(std::in_place_type_t<Rollback>) { return Rollback{"controller"}; }
    Act make(std::in_place_type_t<Add>) {
        if (below(2) == 0) {
            RobotEntry robot{.name = "extra", .model = "raspimouse", .place = {file.string(), 1}};
            robot.pose = {{number(), number()}, 0};
            return Add{robot};
        }
        BehaviorEntry behavior{.name = "extra", .script = "wanderer", .place = {file.string(), 1}};
        behavior.path = folder.path("behaviors/wanderer.lua").string();
        behavior.config = {{"speed", 0.1}};
        return Add{behavior};
    }
    Act make(std::in_place_type_t<Remove>) { return Remove{"extra"}; }
    Act make(std::in_place_type_t<Restart>) {
        write_scripts(random_());
        return Restart{};
    }
    Act make(std::in_place_type_t<Seek>) {
        if (ticks_ > 5000) return Rearm{};  // a past is computed from the start
        const auto& branches = live_->history_until_now().branches();
        const auto& branch = branches[below(branches.size())];
        if (below(4) == 0) return Seek{.branch = branch.name};
        return Seek{branch.name, static_cast<std::int64_t>(below(static_cast<std::uint64_t>(branch.end.tick) + 1)),
                    branch.end.start};
    }
    Act make(std::in_place_type_t<Stop>) { return Stop{}; }
    Act make(std::in_place_type_t<Rearm>) { return Rearm{}; }

    template <std::size_t... kind>
    Act make_any(std::size_t which, std::index_sequence<kind...>) {
        Act act;
        ((kind == which ? void(act = make(std::in_place_type<std::variant_alternative_t<kind, Act>>)) : void()), ...);
        return act;
    }

    void act() {
        const Act act = make_any(below(std::variant_size_v<Act>), std::make_index_sequence<std::variant_size_v<Act>>());
        // What stops a system for long is undone soon.
        const Actor who{one_of({Actor::Kind::console, Actor::Kind::browser}), ""};
        const auto acted = live_->act(act, who);
        if (acted) done.insert(name_of(act));
        if (std::holds_alternative<Seek>(act)) {
            INFO((acted ? "" : describe(acted.error())));
            CHECK(acted);
            see();
        }
        if (below(3) == 0) {
            for (const Act& again :
                 {Act{Rearm{}}, Act{Reset{"controller"}}, Act{Activate{"controller"}}, Act{Activate{"mouse"}}}) {
                if (live_->act(again, who)) done.insert(name_of(again));
            }
        }
    }

    // A tick of a branch has one hash, however often it is come to.
    void see() {
        const ActTime now = live_->when();
        const auto [known, is_new] =
            seen_.try_emplace({live_->history().current(), now.start, now.tick}, live_->trace_hash());
        if (known->second != live_->trace_hash()) FAIL_CHECK("tick " << now.tick << " is another one than before");
    }

    int ticks_ = 0;
    std::uint64_t seed_;
    std::map<std::tuple<std::size_t, int, std::int64_t>, std::uint64_t> seen_;
    std::mt19937_64 random_;
    std::unique_ptr<RunningSystem> live_;
};

/// What a replay has come to.
struct Replayed {
    std::uint64_t hash = 0;
    ActTime end;
    std::string error;
};

inline Replayed replay(const std::filesystem::path& journal) {
    const auto fail = [](const Error& error) { return Replayed{.error = describe(error)}; };
    auto read = Replay::read(journal, journal_version);
    if (!read) return fail(read.error());
    auto live = (*read)->load(RandomRun::makers());
    if (!live) return fail(live.error());
    (*live)->activate();
    for (;;) {
        const auto more = (*read)->before_tick(**live);
        if (!more) return fail(more.error());
        if (!*more) break;
        (*live)->tick();
    }
    return {(*live)->trace_hash(), (*live)->when(), ""};
}

}  // namespace nezumi
