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
        static_cast<void>(folder().write("behaviors/systems/two.lua",
                                         "behavior 'fine' { script = 'none' }\nbehavior 'late' { script = 'late' "
                                         "}\nrobot 'mouse' { model = 'raspimouse' }"));
    }
};

}  // namespace

TEST_CASE("the message of the component is the first line of the report", "[scenario][errors][session]") {
    ErrorRig rig("s:load 'systems/two.lua'\ns:run(1)");
    const SessionEnd end = rig.session();
    CHECK(end.status() == 1);
    CHECK_THAT(rig.said,
               Catch::Matches("FAILED it\n    [^\n]*behaviors/late.lua:3: late went to ERROR: no good\n[^]*"));
}

TEST_CASE("several components in ERROR are all reported, the first as the failure", "[scenario][errors]") {
    const RunResult result =
        ErrorRig("s:load 'systems/two.lua'\ns:behavior 'other' { script = 'late' }\ns:run(1)").run();
    CHECK(outcome_of(result) == "failed: behaviors/late.lua:3: late went to ERROR: no good");
    CHECK(result.facts.back() == "also behaviors/late.lua:3: other went to ERROR: no good");
}

TEST_CASE("the summary omits measures of runs with a component in ERROR, and says so",
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
                                         "ERROR, or not run to the end, omitted)\n"));
}
