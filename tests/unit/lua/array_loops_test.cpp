// Loops over arrays that are read in place, without a call for each element.
#include "bindings/lua/syntax/array_loops.hpp"

#include "tests/unit/lua/rig.hpp"

using namespace nezumi;

namespace {

using Shorts = std::vector<std::int16_t>;

const std::string of_port = "local p = input('p', 'TimedShortSeq') ";

// The text after the declaration with all edits.
std::string looped(const std::string& body, const std::string& declaration = of_port) {
    const std::string text = declaration + body;
    const SyntaxTree tree(text);
    REQUIRE(tree.error() == nullptr);
    TextEdits edits(tree);
    edit_array_loops(tree, edits);
    return edits.text().substr(declaration.size());
}

// What a behaviour with this execution logs for the array { 3, 5, 7 }.
std::vector<std::string> logged(const std::string& body) {
    ScriptRig rig(of_port + "\nfunction on_execute()\n" + body + "\nend");
    rig.activate().feed<Shorts>("p", {3, 5, 7});
    rig.tick();
    REQUIRE(rig.status() == "ACTIVE");
    return rig.log;
}

}  // namespace

TEST_CASE("a loop over an array that is read in place goes by the number of elements", "[lua][port]") {
    CHECK(looped("for i, x in ipairs(p:read()) do f(x) end") ==
          "do local hidden_array_ = p:read() for i = 1, #hidden_array_    do local x = hidden_array_[i] f(x) end end");
    CHECK(looped("for i in ipairs(p:read()) do f(i) end") ==
          "do local hidden_array_ = p:read() for i = 1, #hidden_array_   do f(i) end end");
    CHECK(looped("local r = p:read()\nfor i, x in ipairs(r) do\n f(x)\nend") ==
          "local r = p:read()\nfor i = 1, #r    do local x = r[i]\n f(x)\nend");
}

TEST_CASE("any other loop stays", "[lua][port]") {
    for (const std::string body :
         {"for i, x in ipairs(q) do end", "for i, x in pairs(p:read()) do end",
          "for i, x in ipairs(p:read(), 2) do end", "for i, x, y in ipairs(p:read()) do end",
          "for i, x in ipairs(p:read()), 1 do end", "for i = 1, #p:read() do end",
          "for i, x in ipairs(\np:read()) do end", "for i, x in ipairs(p:read(1)) do end",
          "local r = p:read() for r, x in ipairs(r) do end", "local r = p:read() r = {} for i, x in ipairs(r) do end",
          "local hidden_array_ = 1 for i, x in ipairs(p:read()) do end",
          "q = p:read() for i, x in ipairs(p:read()) do end"}) {
        INFO(body);
        CHECK(looped(body) == body);
    }
    const std::string loop = "for i, x in ipairs(p:read()) do end";
    for (const std::string type : {"'TimedString'", "'TimedOctetSeq2'", "'TimedLong'", "kind", "'TimedPose2D'"}) {
        INFO(type);
        CHECK(looped(loop, "local p = input('p', " + type + ") ") == loop);
    }
    CHECK(looped(loop, "local p = input('p') ") == loop);
}

TEST_CASE("an edited loop does what its text says", "[lua][port]") {
    CHECK(logged("for i, x in ipairs(p:read()) do log.info(i .. ' ' .. x) end") ==
          std::vector<std::string>{"info: 1 3", "info: 2 5", "info: 3 7"});
    CHECK(logged("for i, x in ipairs(p:read()) do if x == 5 then goto next end log.info(x) i = 7 ::next:: end") ==
          std::vector<std::string>{"info: 3", "info: 7"});
    CHECK(logged("for _, x in ipairs(p:read()) do for _, y in ipairs(p:read()) do if y > x then break end "
                 "log.info(x .. y) end end") ==
          std::vector<std::string>{"info: 33", "info: 53", "info: 55", "info: 73", "info: 75", "info: 77"});
    CHECK(logged("local r = p:read() for i, r in ipairs(r) do log.info(r) end log.info(#r)") ==
          std::vector<std::string>{"info: 3", "info: 5", "info: 7", "info: 3"});
    CHECK(logged("for _, x in ipairs(p:read()) do log.info(x) return end") == std::vector<std::string>{"info: 3"});
}

TEST_CASE("an error in an edited loop has its line, and shows no variable that the text has not", "[lua][port]") {
    ScriptRig rig(of_port + "\nfunction on_execute()\n  for i, x in ipairs(p:read()) do\n    x.y = 1\n  end\nend");
    rig.activate().feed<Shorts>("p", {3});
    rig.tick();
    CHECK(rig.error() == "robot_controller.lua:4: attempt to index a number value (local 'x')");
    const auto frames = rig.component->last_error().frames;
    REQUIRE(frames != nullptr);
    std::vector<std::string> names;
    for (const auto& local : frames->all.front().locals) names.push_back(local.name);
    CHECK(names == std::vector<std::string>{"i", "x"});
}

TEST_CASE("lines of edited calls and loops are traced as they are in the text", "[lua][port]") {
    ScriptRig rig(of_port +
                  "\nlocal out = output('out', 'TimedVelocity2D')\nfunction on_execute()\n  local sum = 0\n"
                  "  for i, x in ipairs(p:read()) do\n    sum = sum + x\n    sum = sum + i\n  end\n"
                  "  for _, x in ipairs(p:read()) do sum = sum + x end\n"
                  "  out:write {\n    vx = sum,\n    va = 1,\n  }\nend");
    rig.activate().feed<Shorts>("p", {3, 5});
    rig.component->trace_next();
    rig.tick();
    std::vector<int> lines;
    for (const auto& each : rig.component->latest_trace().lines) lines.push_back(each.line);
    CHECK(lines == std::vector<int>{4, 5, 6, 7, 5, 6, 7, 5, 9, 9, 10, 11, 12, 10, 14});
}
