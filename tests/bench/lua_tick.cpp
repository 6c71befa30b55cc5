// What one tick of a component costs: in Lua, in C++, a port alone; and what a scripted component weighs and takes to
// load.
//
// The tick reads 4 integers, decides and writes a velocity. Limits: Lua 500 ns, C++ 60 ns, port write to read 30 ns, 24
// KB.
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "bindings/lua/script/script_component.hpp"
#include "engine/messages/message_catalog.hpp"
#include "tests/bench/report.hpp"

using namespace nezumi;

namespace {

using Shorts = std::vector<std::int16_t>;

constexpr const char* controller_script = R"(
local range  = input("in", "TimedShortSeq", "distance sensors; a larger value is nearer")
local target = output("out", "TimedVelocity2D", "target velocity")
param("speed_x", 0.1, { min = -1.5, max = 1.5, step = 0.01, widget = "slider", unit = "m/s", doc = "straight-ahead speed" })
param("speed_r", 0.0, { min = -2.0, max = 2.0, step = 0.01, widget = "slider", unit = "rad/s", doc = "rotational speed" })
param("stop_d", 30, { doc = "stop when a sensor value exceeds this" })

local function blocked()
  for _, value in ipairs(range:read()) do
    if value > config.stop_d then return true end
  end
  return false
end

function on_execute()
  if config.speed_x > 0 and blocked() then
    target:write { vx = 0, va = 0 }
  else
    target:write { vx = config.speed_x, va = config.speed_r }
  end
end
)";

constexpr const char* plain_script = R"(
local range  = input("in", "TimedShortSeq")
local target = output("out", "TimedVelocity2D")
function on_execute()
  local v = range:read()
  if v[1] > 30 or v[2] > 30 or v[3] > 30 or v[4] > 30 then
    target:write { vx = 0, va = 0 }
  else
    target:write { vx = 0.1, va = 0 }
  end
end
)";

class Native final : public Component {
public:
    Native() : Component("native", "Native") {}

protected:
    Expected<void> on_execute() override {
        bool blocked = false;
        for (const std::int16_t value : range_.read()) blocked = blocked || value > 30;
        target_.write({.vx = blocked ? 0.0 : 0.1});
        return {};
    }

private:
    InPort<Shorts>& range_ = add_in_port<Shorts>("in");
    OutPort<Velocity2D>& target_ = add_out_port<Velocity2D>("out");
};

// The least of several rounds, in ns for one call.
template <class Work>
double nanoseconds(int calls, const Work& work) {
    double best = 1e300;
    for (int round = 0; round < 15; ++round) {
        const double begin = bench::thread_seconds();
        for (int i = 0; i < calls; ++i) work(i);
        best = std::min(best, (bench::thread_seconds() - begin) / calls * 1e9);
    }
    return best;
}

// Whole ticks of a component: latch a new value, execute, latch what it wrote. And the execution alone.
void measure(const char* name, Component& component, double limit) {
    OutPort<Shorts> source("source");
    component.find_in_port("in")->connect(source);
    if (!component.activate({})) std::puts("can't be activated");
    Time now;
    const double whole = nanoseconds(20'000, [&](int) {
        now = {now.tick + 1, static_cast<double>(now.tick + 1) / 100};
        source.next_pending().assign({1, 2, 3, 4});
        source.latch(now);
        component.latch_inputs(now);
        component.execute(now);
        component.latch_outputs(now);
    });
    const double alone = nanoseconds(20'000, [&](int) {
        now = {now.tick + 1, static_cast<double>(now.tick + 1) / 100};
        component.execute(now);
        component.find_out_port("out")->discard();
    });
    const bool drives = component.find_out_port("out")->value().get<Velocity2D>().vx > 0;
    std::printf("%-34s execute %6.1f ns, with ports %6.1f ns (limit %.0f: %s)%s\n", name, alone, whole, limit,
                bench::verdict(alone, limit), drives ? "" : " (does not drive!)");
}

std::unique_ptr<ScriptComponent> load(const char* text, ChunkCache* chunks = nullptr) {
    auto component =
        ScriptComponent::load("c", {"robot_controller.lua", "robot_controller.lua", text}, {.chunks = chunks});
    if (!component) {
        std::puts(describe(component.error()).c_str());
        std::exit(2);
    }
    return std::move(*component);
}

constexpr const char* velocity_script = R"(
local from = input("in", "TimedVelocity2D")
local to   = output("out", "TimedVelocity2D")
function on_execute()
  local v = from:read()
  to:write { vx = v.vx, vy = v.vy, va = v.va }
end
)";
constexpr const char* described_script = R"(
local from = input("in", "Four")
local to   = output("out", "Four")
function on_execute()
  local v = from:read()
  to:write { a = v.a, b = v.b, c = v.c, d = v.d }
end
)";
constexpr const char* bytes_script = R"(
local from = input("in", "Bytes")
local to   = output("out", "Bytes")
function on_execute() to:write(from:read()) end
)";

// Message types that a file would define: of four numbers, of bytes.
const MessageType* defined(std::string_view name) {
    MessageDefinition definition{.name = std::string(name), .place = {"bench.lua"}};
    if (name == "Four") {
        for (const char* field : {"a", "b", "c", "d"}) definition.fields.push_back({.name = field, .kind = "double"});
    } else {
        definition.fields.push_back({.name = "data", .kind = "bytes"});
    }
    return *MessageCatalog::shared().define(definition, [](const auto&) { return failure("none"); });
}

// One execution that reads what came and writes as much, in ns.
double exchange(const char* script, const Value& value, int calls) {
    auto component = ScriptComponent::load("c", {"exchange.lua", "exchange.lua", script},
                                           {.find_message = [](std::string_view name, std::string_view,
                                                               std::vector<SourceText>*) -> Expected<FoundMessage> {
                                               if (const auto compiled = find_message_type(name))
                                                   return FoundMessage{*compiled};
                                               return FoundMessage{defined(name)};
                                           }});
    if (!component || !(*component)->activate({})) std::exit(2);
    const auto source = make_out_port(message_of(value.type()), "source", "");
    (*component)->find_in_port("in")->connect(*source);
    Time now;
    const double took = nanoseconds(calls, [&](int) {
        now = {now.tick + 1, static_cast<double>(now.tick + 1) / 100};
        source->write_any(value);
        source->latch(now);
        (*component)->latch_inputs(now);
        (*component)->execute(now);
        (*component)->latch_outputs(now);
    });
    if (!((*component)->find_out_port("out")->value() == value)) std::puts("what was read is not what was written");
    return took;
}

void measure_described() {
    const double velocity = exchange(velocity_script, Velocity2D{.vx = 1}, 20'000);
    const double described = exchange(described_script, make_payload(defined("Four")), 20'000);
    std::printf(
        "read and write a TimedVelocity2D   %.0f ns; a described message of 4 numbers %.0f ns, %.2f times (limit 1.5: "
        "%s)\n",
        velocity, described, described / velocity, bench::verdict(described / velocity, 1.5));
    Value bytes = make_payload(defined("Bytes"));
    ValuePlace(bytes).field(bytes.type().fields[0]).as<Octets>().assign(std::size_t{1} << 20, 7);
    std::printf("read and write 1 MB of bytes       %.2f ms\n", exchange(bytes_script, bytes, 100) / 1e6);
}

long resident_kilobytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}

}  // namespace

int main() {
    bench::print_header("a component's tick", "budget 0.1 s, memory limit 64 MB; the best of 15 rounds, CPU time");
    measure("Lua, robot_controller", *load(controller_script), 500);
    measure("Lua, 4 integers and a velocity", *load(plain_script), 500);
    Native native;
    measure("C++, 4 integers and a velocity", native, 60);

    OutPort<Velocity2D> out("out");
    InPort<Velocity2D> in("in");
    in.connect(out);
    double sum = 0;
    const double port = nanoseconds(100'000, [&](int i) {
        const Time now{i, 0};
        out.write({.vx = 1});
        out.latch(now);
        in.latch(now);
        sum += in.read().vx;
    });
    std::printf("port, write to read                %.1f ns (limit 30: %s)%s\n", port, bench::verdict(port, 30),
                sum > 0 ? "" : " (lost!)");

    measure_described();

    constexpr int count = 1000;
    ChunkCache chunks;
    std::vector<std::unique_ptr<ScriptComponent>> all;
    const long before = resident_kilobytes();
    const double begin = bench::thread_seconds();
    for (int i = 0; i < count; ++i) all.push_back(load(controller_script, &chunks));
    const double took = bench::thread_seconds() - begin;
    const double kilobytes = static_cast<double>(resident_kilobytes() - before) / count;
    std::printf(
        "a scripted component               %.1f KB in Lua, %.1f KB in all (limit 24: %s); %d loaded in %.3f s\n",
        static_cast<double>(all[0]->script().memory()) / 1024, kilobytes, bench::verdict(kilobytes, 24), count, took);
}
