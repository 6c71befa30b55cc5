// What `nezumi types` says, as a table and as annotations for an editor.
#include <catch2/catch.hpp>
#include <lua.hpp>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bindings/cli/base/environment.hpp"
#include "bindings/lua/files/system_lua.hpp"
#include "bindings/lua/script/script_globals.hpp"
#include "bindings/lua/stubs/annotations.hpp"
#include "bindings/lua/stubs/type_table.hpp"
#include "bindings/scenario/scenario_fields.hpp"
#include "bindings/scenario/scenario_methods.hpp"
#include "engine/tree/member.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;

namespace {

struct CloseLua {
    void operator()(lua_State* lua) const { lua_close(lua); }
};

// What the plugin puts before a file; "" for nothing.
std::string put_before(const std::string& uri, const std::string& text) {
    const std::unique_ptr<lua_State, CloseLua> owner(luaL_newstate());
    lua_State* lua = owner.get();
    luaL_openlibs(lua);
    REQUIRE(luaL_dostring(lua, annotations_plugin) == LUA_OK);
    lua_getglobal(lua, "OnSetText");
    lua_pushstring(lua, uri.c_str());
    lua_pushstring(lua, text.c_str());
    REQUIRE(lua_pcall(lua, 2, 1, 0) == LUA_OK);
    if (lua_isnil(lua, -1)) return "";
    lua_geti(lua, -1, 1);
    lua_getfield(lua, -1, "text");
    return lua_tostring(lua, -1);
}

std::vector<std::string> names_of(std::span<const MemberInfo> members) {
    std::vector<std::string> names;
    for (const MemberInfo& member : members) names.emplace_back(member.name);
    return names;
}

}  // namespace

TEST_CASE("the table of types has every message type", "[cli][types]") {
    const std::string table = type_table();
    for (const std::string_view name : compiled_message_names()) {
        CHECK(("\n" + table).find("\n" + std::string(name) + ": ") != std::string::npos);
    }
}

TEST_CASE("the annotations are the committed ones", "[cli][types]") {
    // After a change that is meant: the same change there. `nezumi types --lua` also has the installed definitions.
    const bool same =
        annotations(scenario_records(), cli::peer_words()) == text_of_file(source_root() + "/tests/golden/nezumi.lua");
    CHECK(same);
}

TEST_CASE("the annotations are Lua, and have every word and a class for every type and direction", "[cli][types]") {
    const std::string text = annotations(scenario_records(), cli::peer_words());
    CHECK(text.find("---@meta\n") == 0);
    const std::unique_ptr<lua_State, CloseLua> lua(luaL_newstate());
    CHECK(luaL_loadstring(lua.get(), text.c_str()) == LUA_OK);

    const auto has = [&](const std::string& line) { return text.find("\n" + line) != std::string::npos; };
    for (const std::string_view type : compiled_message_names()) {
        CHECK(has("---@class " + std::string(type) + ".In : InPort\n"));
        CHECK(has("---@class " + std::string(type) + ".Out : OutPort\n"));
    }
    for (const std::string_view name : script_globals()) {
        if (name == "require") continue;  // Lua's own
        const std::string word(name);
        CAPTURE(word);
        CHECK((has("function " + word + "(") || has(word + " = ")));
    }
    for (const std::string_view name : system_word_names(cli::peer_words())) {
        const std::string word(name);
        CAPTURE(word);
        CHECK(has("function " + word + "("));
        CHECK(has("function s:" + word + "(") ==
              (word != "seed" && word != "argument"));  // a run's are s.seed and the sweep's
    }
}

TEST_CASE("the annotations have every word of behaviours, systems, robots, scenarios and components", "[cli][types]") {
    const std::string text = annotations(scenario_records(), cli::peer_words());
    const auto has = [&](const std::string& line) { return text.find("\n" + line) != std::string::npos; };
    // The words that users rely on, as they write them: a word that is renamed or left out shows here.
    const std::vector<std::string> globals{
        "input",    "output",   "param",      "about",   "command",      "probe",      "task",           "start",
        "cancel",   "wait",     "wait_until", "now",     "on_activated", "on_execute", "on_deactivated", "on_aborting",
        "on_error", "on_reset", "on_reload",  "arena",   "box",          "wall",       "cylinder",       "marker",
        "floor",    "csv",      "map",        "maze",    "line",         "robot",      "behavior",       "component",
        "connect",  "seed",     "rate",       "physics", "robot_model",  "scenario",   "range"};
    for (const std::string& word : globals) {
        CAPTURE(word);
        CHECK(has("function " + word + "("));
    }
    for (const std::string word : {"config", "state", "dt", "log"}) {
        CAPTURE(word);
        CHECK(has(word + " = "));
    }
    for (const std::string_view method : ScenarioRun::Methods::names(cli::peer_words())) {
        const std::string word(method);
        CAPTURE(word);
        CHECK((has("function s:" + word + "(") || (word == "world" && has("---@field world World "))));
    }
    // By class: a name of one class is not a name of another.
    const std::vector<std::pair<std::string, std::vector<std::string>>> fields{
        {"InPort", {"is_new", "tm", "age", "connected", "stale"}},
        {"TimedShortSeq.In : InPort", {"read"}},
        {"TimedShortSeq.Out : OutPort", {"write"}},
        {"(exact) TimedShortSeq.InOptions", {"queue"}},
        {"(exact) TimedVelocity2D.OutOptions", {"safe"}},
        {"(exact) ParameterOptions",
         {"min", "max", "step", "widget", "unit", "doc", "choices", "min_size", "max_size"}},
        {"(exact) AboutFields", {"version", "vendor", "category"}},
        {"Log", {"debug", "info", "warn", "error"}},
        {"(exact) TaskOptions", {"repeating"}},
        {"(exact) WaitOptions", {"within"}},
        {"(exact) BoxFields", {"at", "size", "yaw", "color", "mass"}},
        {"(exact) WallFields", {"from", "to", "height", "thickness"}},
        {"(exact) CylinderFields", {"at", "radius", "height", "mass"}},
        {"(exact) MarkerFields", {"name", "id", "size", "at", "facing"}},
        {"(exact) FloorFields", {"image", "size"}},
        {"(exact) LineFields", {"points", "width", "color"}},
        {"(exact) MazeFields", {"rows", "cell", "at", "generate"}},
        {"(exact) ArenaFields", {"size", "border"}},
        {"(exact) PhysicsFields", {"step"}},
        {"(exact) RobotFields", {"model", "pose", "limits", "backend", "noise", "friction", "sensors", "hardware"}},
        {"(exact) BehaviorFields", {"script", "config", "sets", "set", "rate", "active"}},
        {"(exact) ComponentFields", {"type", "config", "rate", "on", "at", "yaw"}},
        {"(exact) RobotModelFields", {"base", "mass", "body", "drive", "sensors", "ports", "hardware"}},
        {"(exact) DriveFields", {"radius", "track", "limits"}},
        {"(exact) SensorFields", {"kind", "at", "yaw", "table", "response", "noise"}},
        {"(exact) ScenarioOptions", {"timeout", "sweep", "samples"}},
        {"(exact) ExpectationOptions", {"within", "hold"}},
        {"Port", names_of(port_members())},
        {"Component", names_of(component_members())},
        {"TaskView", {"status", "waiting", "line", "since"}},
        {"ProbeView", {"value", "tm", "age"}},
    };
    for (const auto& [name, words] : fields) {
        CAPTURE(name);
        const auto begin = text.find("\n---@class " + name + "\n");
        REQUIRE(begin != std::string::npos);
        const std::string its = text.substr(begin, text.find("\n\n", begin) - begin);
        for (const std::string& word : words) {
            CAPTURE(word);
            CHECK((its.find("\n---@field " + word + " ") != std::string::npos ||
                   its.find("\n---@field " + word + "? ") != std::string::npos));
        }
    }
}

TEST_CASE("a port's class has the types that it reads and writes", "[cli][types]") {
    const std::string text = annotations(scenario_records(), cli::peer_words());
    const auto has = [&](const std::string& line) { return text.find("\n" + line + "\n") != std::string::npos; };
    CHECK(has("---@field read fun(self: TimedShortSeq.In): integer[]"));
    CHECK(has("---@field write fun(self: TimedVelocity2D.Out, value: Velocity2D.Written)"));
    CHECK(has("---@field vx number [m/s] speed along the robot's x axis (forward)"));
    CHECK(has("---@field vx? number [m/s] speed along the robot's x axis (forward)"));
    CHECK(
        has("---@overload fun(name: string, type: \"TimedShortSeq\", doc?: string, options?: "
            "TimedShortSeq.InOptions): TimedShortSeq.In"));
}

TEST_CASE("the editor's plugin gives config the parameters that a file declares", "[cli][types]") {
    CHECK(put_before("file:///p/behaviors/avoider.lua",
                     "param(\"speed_x\", 0.0, { min = -1.5 })\n"
                     "param('stop_d', 30)\n"
                     "param(\"eager\", true, {})\n"
                     "param(\"words\", \"a, b\")\n"
                     "param(\"gains\", { 1.0, 0.5 })\n"
                     "  param( \"steps\" , { 1, 2 }, {})\n") ==
          "---@class (exact) Config.avoider\n"
          "---@field speed_x number\n"
          "---@field stop_d integer\n"
          "---@field eager boolean\n"
          "---@field words string\n"
          "---@field gains number[]\n"
          "---@field steps integer[]\n"
          "local config\n");
    CHECK(put_before("file:///p/behaviors/none.lua", "local my_param = 1\nlog.info('param')\n") == "");
}
