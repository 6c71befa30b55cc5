// Commands for all components together, for the log level, and for drawings.
#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>
#include <string>
#include <utility>

#include "tests/unit/console/session_rig.hpp"

using namespace nezumi;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

TEST_CASE("a component that can't be activated is reported, and the others are activated", "[console][session][act]") {
    SessionRig it(counter_system + "behavior \"bad\" { script = \"bad\", active = false }\n",
                  {{"counter", counter_behavior}, {"bad", "function on_activated() error('no luck') end"}});
    it.type("deactivate()");
    const std::string said = it.type("activate()");
    CHECK_THAT(said, StartsWith("ACTIVE now: mouse, controller\n! activate: "));
    CHECK_THAT(said, Contains("no luck"));
    CHECK(it.type("bad.status") == "\"ERROR\"");
    CHECK(it.type("activate()") == "no component is INACTIVE");
}

TEST_CASE("pictures and graphs are drawn within the project", "[console][session]") {
    std::string drawn;
    const Scratch outside;
    SessionOptions options;
    options.drawing_maker = [&drawn](Drawn what) -> Drawing {
        return [&drawn, what](const std::string& file) -> Expected<void> {
            drawn +=
                (what == Drawn::world ? "world " : "wiring ") + std::filesystem::path(file).filename().string() + ";";
            if (file.find("full") != std::string::npos) return failure("the disk is full", {file});
            return {};
        };
    };
    SessionRig it(counter_system, {{"counter", counter_behavior}}, std::move(options));
    const std::string home = it.folder.path("").parent_path().string();
    CHECK(it.type("picture '" + home + "/now.png'") == "wrote " + home + "/now.png");
    CHECK(it.type("graph '" + home + "/wiring'") == "wrote " + home + "/wiring.svg");
    CHECK(drawn == "world now.png;wiring wiring.svg;");
    CHECK(it.type("picture '" + home + "/now.gif'") ==
          "! picture: the name of a picture must end in .png or .svg: write picture \"" + home + "/now.png\"");
    CHECK(it.type("graph '" + outside.path("x.svg").string() + "'") ==
          "! graph: '" + outside.path("x.svg").string() + "' lies outside of the project: it must be saved in " + home +
              " or below");
    CHECK(it.type("picture '" + home + "/full.png'") == "! picture: " + home + "/full.png: the disk is full");
    CHECK_THAT(it.type("picture()"), StartsWith("! picture: expected the name of a file, as in picture \"x.png\""));
    SessionRig without;
    CHECK(without.type("graph 'x.svg'") == "! graph: this program can't draw: use `nezumi run`");
}
