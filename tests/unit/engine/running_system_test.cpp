// A running system whose components are all in C++: it needs no language.
#include "engine/live/running_system.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/engine/try_component.hpp"

using namespace nezumi;

namespace {

std::string error_of(const Expected<ActResult>& done) { return done ? "" : describe(done.error()); }

std::unique_ptr<RunningSystem> run_native() {
    LiveOptions options;
    options.components["Try"]["sim"] = [](const ComponentEntry& entry, System&) {
        return Expected<std::unique_ptr<Component>>(std::make_unique<TryComponent>(entry.name));
    };
    SystemSpec spec;
    spec.entries.emplace_back(ComponentEntry{.name = "it", .type = "Try"});
    auto live = RunningSystem::make(std::move(spec), Project::of("system.lua"), std::move(options));
    REQUIRE(live);
    (*live)->activate();
    return std::move(*live);
}

}  // namespace

TEST_CASE("a system of C++ components runs, is changed by acts and starts again without scripts", "[engine][live]") {
    const auto live = run_native();
    for (int i = 0; i < 10; ++i) live->tick();
    CHECK(live->system().find("it")->executions() == 10);
    CHECK(error_of(live->act(Add{ComponentEntry{.name = "other", .type = "Try"}}, {})).empty());
    CHECK(error_of(live->act(Activate{"other"}, {})).empty());
    live->tick();
    CHECK(live->system().find("other")->executions() == 1);
    CHECK(error_of(live->act(Remove{"it"}, {})).empty());
    CHECK(error_of(live->act(Restart{}, {})).empty());
    CHECK(live->starts() == 2);
    CHECK(live->system().now().tick == 0);
    CHECK(live->system().find("it") == nullptr);  // it comes from no file: it starts as it was
    CHECK(live->system().find("other") != nullptr);
}

TEST_CASE("acts that need scripts are refused in a program without scripts", "[engine][live]") {
    const auto live = run_native();
    constexpr auto none = "this program can't run scripts: it has only components in C++";
    CHECK(error_of(live->act(Add{BehaviorEntry{.name = "b", .script = "b", .path = "b.lua"}}, {})) == none);
    CHECK(error_of(live->act(Reload{.component = "it"}, {})) == "it has no script: only behaviours can be reloaded");
    CHECK(error_of(live->act(Rollback{"it"}, {})) == "it has no script: only behaviours can be reloaded");
    CHECK(error_of(live->act(Reload{.files = {"b.lua"}}, {})).empty());  // nothing comes from it
    CHECK(error_of(live->act(Reload{}, {})).empty());
    CHECK(RunningSystem::load("system.lua", {}).error().message == none);
    CHECK(live->explain_next("it").error().message == "it is not a behaviour: it has no lines");
}

TEST_CASE("a message for a port that is known is the act of its path, and refused as that", "[engine][live]") {
    struct Acts final : ActObserver {
        void acted(const ActTime& /*when*/, std::shared_ptr<const PastAct> act,
                   const Expected<ActResult>& /*result*/) override {
            ports.push_back(std::get<Inject>(act->act).port);
        }
        void ran_out_of_time(const ActTime& /*when*/, const std::string& /*component*/,
                             const Component::OutOfTime& /*call*/) override {}
        std::vector<std::string> ports;
    } acts;
    const auto live = run_native();
    live->observe_acts(&acts);
    const Port& port = *live->system().port("it.in").value();
    CHECK(error_of(live->deliver(port, Inject{"it.in", 7}, {})).empty());
    live->tick();
    CHECK(port.value().get<std::int32_t>() == 7);
    const Inject wrong{"it.in", 0.5};
    CHECK(error_of(live->deliver(port, wrong, {})) == error_of(live->act(wrong, {})));
    CHECK(acts.ports == std::vector<std::string>(3, "it.in"));
}
