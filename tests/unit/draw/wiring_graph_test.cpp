// The graph of a system: where its boxes stand, and that odd ones draw as well.
#include "bindings/draw/wiring_graph.hpp"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/live_rig.hpp"

using namespace nezumi;
using namespace nezumi::draw;

namespace {

// Nodes with a port each way, connected so.
WiringOf with_wires(std::size_t nodes, const std::vector<std::pair<std::size_t, std::size_t>>& edges) {
    WiringOf wiring{.title = "test"};
    for (std::size_t i = 0; i < nodes; ++i)
        wiring.nodes.push_back({.name = "n" + std::to_string(i), .ins = {{"in"}}, .outs = {{"out"}}});
    for (const auto& [from, to] : edges) wiring.edges.push_back({from, 0, to, 0});
    return wiring;
}

using Columns = std::vector<std::size_t>;

}  // namespace

TEST_CASE("a graph's columns follow the data flow, and cycles have backward connections", "[draw][graph]") {
    CHECK(columns_of(with_wires(0, {})) == Columns{});
    CHECK(columns_of(with_wires(3, {{0, 1}, {1, 2}, {0, 2}})) == Columns{0, 1, 2});
    CHECK(columns_of(with_wires(3, {{2, 1}, {1, 0}})) == Columns{2, 1, 0});
    CHECK(columns_of(with_wires(2, {{0, 1}, {1, 0}})) == Columns{0, 1});  // a robot and what drives it
    CHECK(columns_of(with_wires(2, {{0, 0}})) == Columns{0, 0});          // to itself
    CHECK(columns_of(with_wires(4, {{0, 1}, {1, 2}, {2, 1}, {3, 2}})) == Columns{0, 1, 2, 0});
}

TEST_CASE("a graph shows components, states, ports and connections", "[draw][graph]") {
    LiveRig it;
    const WiringOf wiring = wiring_of(*it.live, "counter");
    REQUIRE(wiring.nodes.size() == 2);
    CHECK(wiring.nodes[0].name == "mouse");
    CHECK(wiring.nodes[1].name == "controller");
    CHECK(wiring.nodes[1].type == "Counter");
    CHECK(wiring.nodes[1].status == "ACTIVE");
    REQUIRE(wiring.edges.size() == 2);
    CHECK(wiring.nodes[wiring.edges[0].from].outs[wiring.edges[0].out].name == "ir_sensor_out");
    CHECK(wiring.nodes[wiring.edges[0].to].ins[wiring.edges[0].in].name == "in");
    CHECK(wiring.nodes[1].ins[0].connected);
    for (const std::string name : {"w.svg", "w.png"}) {
        const std::string file = it.folder.path(name).string();
        REQUIRE(draw_wiring(wiring, file));
        CHECK(text_of_file(file).size() > 1000);
        REQUIRE(draw_wiring(with_wires(1, {{0, 0}}), file));
        REQUIRE(draw_wiring({}, file));
    }
    CHECK_FALSE(draw_wiring(wiring, it.folder.path("none/w.svg").string()));
}

TEST_CASE("a run draws its picture and graph to the requested files", "[draw][graph]") {
    const Scratch files;
    files.write("behaviors/it.lua", "function on_execute() end\n");
    files.write("behaviors/systems/s.lua", "robot 'mouse' { model = 'raspimouse' }\nbehavior 'it' { script = 'it' }\n");
    const std::string input = files.write("commands", "graph 'wiring.svg'\npicture 'now.png'\n").string();
    const Outcome outcome = run_nezumi({"run", "s", "--batch"}, files.path("").string(), input);
    CHECK(outcome.status == 0);
    CHECK(outcome.out == "wrote wiring.svg\nwrote now.png\n");
    CHECK(text_of_file(files.path("wiring.svg")).find("<svg") != std::string::npos);
    CHECK(text_of_file(files.path("now.png")).starts_with("\x89PNG"));
}
