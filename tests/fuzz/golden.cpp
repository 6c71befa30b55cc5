// Compares a run with anything as its golden: it agrees, or the error is one line with the scenario's place.
#include "bindings/scenario/golden.hpp"

#include <memory>

#include "engine/components/component.hpp"
#include "engine/system/system.hpp"
#include "engine/trace/trace.hpp"
#include "tests/fuzz/memory_file.hpp"

using namespace nezumi;

namespace {

// Carries numbers and texts, a list that grows, and two messages in some ticks.
class Talker final : public Component {
public:
    Talker() : Component("it", "Talker") {}

private:
    Expected<void> on_execute() override {
        const auto count = static_cast<double>(executions());
        speed_.write({.vx = 0.1 * count, .va = -1e-9});
        if (executions() % 2 == 0) speed_.write({});
        text_.write("a,\"b\"\n");
        return {};
    }

    OutPort<Velocity2D>& speed_ = add_out_port<Velocity2D>("speed");
    OutPort<std::string>& text_ = add_out_port<std::string>("text");
};

Golden run(const std::string& file, double tolerance) {
    static System system{{}, nullptr};
    static Trace trace;
    static const std::vector<const Channel*> channels = [] {
        trace.start(system);
        require(system.add(std::make_unique<Talker>()).value()->activate(system.now()).has_value());
        return std::vector{*trace.follow("it.speed"), *trace.follow("it.text")};
    }();
    Golden golden(file, "it.csv", tolerance, {.file = "it_test.lua", .line = 3}, channels);
    for (int i = 0; i < 3; ++i) {
        system.tick();
        golden.add(0.01 * (i + 1));
    }
    return golden;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const MemoryFile file;
    static const Golden exact = run(file.path(), 0);
    static const Golden wide = run(file.path(), 0.5);
    file.hold(data, size);
    for (const Golden* golden : {&exact, &wide}) {
        const auto same = golden->finish(false);
        if (!same) check(same.error());
    }
    return 0;
}
