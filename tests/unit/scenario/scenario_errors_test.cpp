// Components that go to ERROR: they fail the scenario, unless it has allowed that.
#include <catch2/catch.hpp>

#include "tests/unit/scenario/scenario_rig.hpp"

using namespace nezumi;

namespace {

// Two behaviours: "late" fails at 0.5 s, "fine" never does.
class ErrorRig : public ScenarioRig {
public:
    explicit ErrorRig(const std::string& body) : ScenarioRig("scenario('it', function(s)\n" + body + "\nend)") {
        static_cast<void>(folder().write("behaviors/late.lua",
                                         "param('at', 0.5)\n"
                                         "function on_execute()\n"
                                         "  if now() >= config.at - 1e-9 then error('no good') end\n"
                                         "end"));
        static_cast<void>(folder().write("behaviors/dead.lua", "function on_activated() error('never lived') end"));
        static_cast<void>(folder().write("behaviors/systems/two.lua",
                                         "behavior 'fine' { script = 'none' }\nbehavior 'late' { script = 'late' "
                                         "}\nrobot 'mouse' { model = 'raspimouse' }"));
        static_cast<void>(folder().write("behaviors/systems/dead.lua",
                                         "behavior 'it' { script = 'dead' }\nbehavior 'fine' { script = 'none' }"));
    }
};

}  // namespace

TEST_CASE("a component that goes to ERROR fails the scenario in that tick", "[scenario][errors]") {
    ErrorRig rig(
        "s:load 'systems/two.lua'\n"
        "s:always('it is well', function() return s.late.status == 'ACTIVE' end)\n"
        "s:run(10)");
    const RunResult result = rig.run();
    CHECK(outcome_of(result) == "failed: behaviors/late.lua:3: late went to ERROR: no good");
    REQUIRE(result.facts.size() == 2);
    CHECK(result.facts[0] == "at 0.51 s of simulated time");
    CHECK(result.facts[1] == "s:allow_error(\"late\") before that lets the scenario go on");
}

TEST_CASE("the message of the component is the first line of the report", "[scenario][errors][session]") {
    ErrorRig rig("s:load 'systems/two.lua'\ns:run(1)");
    const SessionEnd end = rig.session();
    CHECK(end.status() == 1);
    CHECK_THAT(rig.said,
               Catch::Matches("FAILED it\n    [^\n]*behaviors/late.lua:3: late went to ERROR: no good\n[^]*"));
}

TEST_CASE("an allowed ERROR lets the scenario go on, for good", "[scenario][errors]") {
    const std::string goes_on =
        "s:run(1) s:check(s.late.status == 'ERROR', s.late.status)\n"
        "s.late:reset() s.late.config.at = 2 s.late:activate() s:run(2) s:check(s.late.status == 'ERROR')";
    CHECK(outcome_of(ErrorRig("s:load 'systems/two.lua' s:allow_error 'late'\n" + goes_on).run()) == "passed");
    CHECK(outcome_of(ErrorRig("s:load 'systems/two.lua' s:allow_error(s.late)\n" + goes_on).run()) == "passed");
}

TEST_CASE("an allowed ERROR is that of one component of one world", "[scenario][errors]") {
    const std::string failed = "failed: behaviors/late.lua:3: late went to ERROR: no good";
    CHECK(outcome_of(ErrorRig("s:load 'systems/two.lua' s:allow_error 'fine' s:run(1)").run()) == failed);
    CHECK(
        outcome_of(ErrorRig("s:load 'systems/two.lua' s:allow_error 'late' s:load 'systems/two.lua' s:run(1)").run()) ==
        failed);
    CHECK_THAT(outcome_of("s:load 'systems/stop_at_wall.lua' s:allow_error 'mouze'"),
               Catch::Contains("allow_error: there is no component 'mouze' (did you mean 'mouse'?)"));
}

TEST_CASE("a behaviour that can't be activated is reported as that, at the start", "[scenario][errors]") {
    const std::string failed = "failed: behaviors/dead.lua:1: it went to ERROR: never lived";
    for (const char* body :
         {"s:run(1)", "s:maintain('something', { hold = 1, within = 1 }, function() return false end)",
          "s:eventually('something', { within = 1 }, function() return false end)", ""}) {
        const RunResult result = ErrorRig("s:load 'systems/dead.lua'\n" + std::string(body)).run();
        CHECK(outcome_of(result) == failed);
        CHECK(result.facts.front() == "at 0.00 s of simulated time");
    }
    CHECK(outcome_of(ErrorRig("s:load 'systems/dead.lua' s:allow_error 'it' s:run(1)").run()) == "passed");
}

TEST_CASE("of several components in ERROR all are told, the first as the failure", "[scenario][errors]") {
    const RunResult result =
        ErrorRig("s:load 'systems/two.lua'\ns:behavior 'other' { script = 'late' }\ns:run(1)").run();
    CHECK(outcome_of(result) == "failed: behaviors/late.lua:3: late went to ERROR: no good");
    CHECK(result.facts.back() == "also behaviors/late.lua:3: other went to ERROR: no good");
}

TEST_CASE("a version that is rolled back has not gone to ERROR", "[scenario][errors]") {
    CHECK(outcome_of(ErrorRig("s:load 'systems/two.lua'\n"
                              "s:reload('fine', { text = \"param('x', 1) function on_execute() error('no') end\" })\n"
                              "s:run(0.3) s:check(s.fine.status == 'ACTIVE') s:check(s.fine.version == 1)")
                         .run()) == "passed");
}

TEST_CASE("measures of runs with a component in ERROR are left out of the summary, which says so",
          "[scenario][errors][measures][session]") {
    ScenarioRig rig(
        "scenario('it', { sweep = { at = { 0.2, 0.4, 5 } } }, function(s, p)\n"
        "  s:behavior 'late' { script = 'late', config = { at = p.at } }\n"
        "  s:measure('at', p.at, 's')\n"
        "  s:run(1)\n"
        "end)");
    static_cast<void>(rig.folder().write("behaviors/late.lua",
                                         "param('at', 0.5)\n"
                                         "function on_execute() if now() >= config.at then error('no good') end end"));
    const SessionEnd end = rig.session();
    CHECK(end.summary.failed == 2);
    CHECK(end.measured.size() == 3);
    CHECK_THAT(rig.said, Catch::Contains("\nat [s] of it: 1 run, min 5, median 5, mean 5, max 5 (2 with a component in "
                                         "ERROR, or not run to the end, left out)\n"));
}
