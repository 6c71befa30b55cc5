// What is refused when a file loads, with its line and the nearest known name.
#include "tests/unit/lua/rig.hpp"

using namespace nezumi;

namespace {

const std::string at1 = "robot_controller.lua:1: ";

std::string starts(const std::string& text, std::size_t length) { return text.substr(0, length); }

}  // namespace

TEST_CASE("a file that declares nothing is refused as empty", "[lua][refusals]") {
    const std::string empty =
        "robot_controller.lua: the file declares nothing: no port, parameter, command, task or callback";
    CHECK(refusal("") == empty);
    CHECK(refusal("-- nothing yet\n") == empty);
    CHECK(refusal("local x = 1") == empty);
    CHECK(refusal("about { version = '1' }") == empty);
    CHECK(refusal("function on_execute() end") == "");
    CHECK(refusal("command('a', function() end)") == "");
}

TEST_CASE("a syntax error is told with its line", "[lua][refusals]") {
    CHECK(refusal("function on_execute( end") == at1 + "<name> or '...' expected near 'end'");
    CHECK(refusal("\n\nlocal x = = 1") == "robot_controller.lua:3: unexpected symbol near '='");
    CHECK(refusal("\x1bLua") == at1 + "this is bytecode: only Lua source text is run");
}

TEST_CASE("an unknown callback names the nearest", "[lua][refusals]") {
    CHECK(refusal("function on_exceute() end") ==
          "robot_controller.lua:1:10: unknown callback 'on_exceute' (did you mean 'on_execute'?)");
    CHECK(refusal("on_activate = function() end") ==
          "robot_controller.lua:1:1: unknown callback 'on_activate' (did you mean 'on_activated'?)");
    CHECK(refusal("function on_start() end") ==
          "robot_controller.lua:1:10: unknown callback 'on_start' (there are on_activated, on_execute, on_deactivated, "
          "on_aborting, on_error, on_reset, on_reload)");
}

TEST_CASE("a library that behaviours don't have is refused with what there is instead", "[lua][refusals]") {
    CHECK(
        refusal("sleep(1)") ==
        "robot_controller.lua:1:1: unknown global 'sleep': `wait(seconds)` waits, in a task: task(\"name\", function() "
        "... end)");
    CHECK(refusal("local t = os.clock()") ==
          "robot_controller.lua:1:11: unknown global 'os': the time is now(); there are no files and no processes");
    CHECK(refusal("io.write('x')") ==
          "robot_controller.lua:1:1: unknown global 'io': `log` writes lines, and `nezumi run --record` what ports "
          "carry");
    CHECK(refusal("self.count = 1") ==
          "robot_controller.lua:1:1: unknown global 'self': a behaviour is its file: parameters are in `config`, what "
          "is kept in `state` and locals");
    CHECK(refusal("local m = {} function m:count() self.n = 1 end function on_execute() m:count() end").empty());
    CHECK(refusal("debug.traceback()") ==
          "robot_controller.lua:1:1: unknown global 'debug': `print` and the console show values");
    for (const std::string name : {"load", "loadfile", "loadstring", "dofile", "package"}) {
        CHECK(refusal(name + "('x')") ==
              "robot_controller.lua:1:1: unknown global '" + name + "': code comes from files, by `require`");
    }
    CHECK(refusal("collectgarbage()") ==
          "robot_controller.lua:1:1: unknown global 'collectgarbage': memory is collected by itself");
    CHECK(refusal("unpack({})") == "robot_controller.lua:1:1: unknown global 'unpack': it is table.unpack in Lua 5.4");
}

TEST_CASE("a field that a library does not have is refused with the nearest or with what there is in Lua 5.4",
          "[lua][refusals]") {
    const auto says = [](const std::string& code) {
        return refusal("function on_execute() if now() > 9e9 then " + code + " end end");
    };
    const std::string at = "robot_controller.lua:1:54: unknown field '";
    CHECK(says("print(math.flor(1.5))") == at + "math.flor' (did you mean 'math.floor'?)");
    CHECK(says("print(math.qqqqq)") == at + "math.qqqqq'");
    CHECK(says("print(math['flor'])") == at + "math.flor' (did you mean 'math.floor'?)");
    for (const auto& [name, hint] : std::vector<std::pair<std::string, std::string>>{
             {"math.atan2", "it is math.atan(y, x) in Lua 5.4"},
             {"math.pow", "it is x ^ y in Lua 5.4"},
             {"math.log10", "it is math.log(x, 10) in Lua 5.4"},
             {"string.gfind", "it is string.gmatch in Lua 5.4"},
             {"string.dump", "code comes from files, by `require`"},
             {"table.getn", "it is #t in Lua 5.4"},
             {"table.foreachi", "it is `for i, value in ipairs(t) do` in Lua 5.4"}}) {
        const std::string column = std::to_string(43 + 6 + name.find('.') + 1);
        CHECK(says("print(" + name + "(1))") ==
              "robot_controller.lua:1:" + column + ": unknown field '" + name + "': " + hint);
    }
    CHECK(refusal("print(bit32.band(1, 2))") ==
          "robot_controller.lua:1:7: unknown global 'bit32': Lua 5.4 has operators for bits: & | ~ << >>");
    CHECK(refusal("print(None)") == "robot_controller.lua:1:7: unknown global 'None': it is nil in Lua");
}

TEST_CASE("a library's name that means something else, and a field that there is, are left alone", "[lua][refusals]") {
    CHECK(refusal("local math = { flor = print } function on_execute() math.flor(1) end").empty());
    CHECK(refusal("local function f(table) return table.getn end function on_execute() f {} end").empty());
    CHECK(refusal("local t = {} function t:f() return self.math.flor end function on_execute() end").empty());
    CHECK(refusal("function on_execute() print(math.pi, math.huge, utf8.charpattern, string.format, table.pack, "
                  "coroutine.wrap, math['floor'], math['fl' .. 'or']) end")
              .empty());
    CHECK(failure_of("", "math.flor = print") == "robot_controller.lua:3: can't set 'math.flor': 'math' is read-only");
}

TEST_CASE("what another language would say is refused with what Lua says", "[lua][refusals]") {
    const std::pair<const char*, const char*> slips[] = {
        {"if a != b then end", "'then' expected near '!': it is ~= in Lua"},
        {"x += 1", "syntax error near '+': Lua has no such assignment: write x = x + 1"},
        {"x++", "syntax error near '+': Lua has no such assignment: write x = x + 1"},
        {"if x = 3 then end", "'then' expected near '=': == compares in Lua, and = assigns"},
        {"while f(x) = 3 do end", "'do' expected near '=': == compares in Lua, and = assigns"},
        {"if a && b then end", "unexpected symbol near '&': it is `and` in Lua"},
        {"if a || b then end", "unexpected symbol near '|': it is `or` in Lua"},
        {"if !a then end", "unexpected symbol near '!': it is `not` in Lua"},
        {"if a then f() elif b then end", "syntax error near 'b': it is `elseif` in Lua"},
        {"def f() end", "syntax error near 'f': it is `function` in Lua"},
        {"let x = 3", "syntax error near 'x': it is `local` in Lua"},
        {"// first", "unexpected symbol near '//': a comment begins with -- in Lua"},
        {"x = = 1", "unexpected symbol near '='"},
    };
    for (const auto& [text, says] : slips) {
        INFO(text);
        CHECK(refusal(text) == at1 + says);
    }
}

TEST_CASE("a system file in the place of a behaviour is told as such", "[lua][refusals]") {
    for (const std::string word : {"arena", "robot", "behavior", "component", "connect"}) {
        CHECK(refusal(word + " 'x'") == "robot_controller.lua:1:1: unknown global '" + word +
                                            "': it is of system files, and this is to be a behaviour");
    }
}

TEST_CASE("a callback is a global function, defined once, while the file loads", "[lua][refusals]") {
    CHECK(refusal("on_execute = 5") == at1 + "on_execute expected a function, got number");
    CHECK(refusal("function on_execute() end\nfunction on_execute() end") ==
          "robot_controller.lua:2: on_execute is defined twice (first in line 1)");
    CHECK(refusal("local function on_execute() end") ==
          "robot_controller.lua:1:16: 'on_execute' is local, so it would never be called: leave out `local`");
    CHECK(refusal("local on_error = print") ==
          "robot_controller.lua:1:7: 'on_error' is local, so it would never be called: leave out `local`");
    CHECK(refusal("if true then function on_execute() end else function on_execute() end end") == "");
    CHECK(failure_of("", "on_error = print") ==
          "robot_controller.lua:3: on_error can only be defined while the file loads");
    CHECK(failure_of("function on_error() end", "on_error() assert(on_reset == nil and on_execute ~= nil)") == "");
}

TEST_CASE("every global that is not known is refused, also in code that never runs", "[lua][refusals]") {
    CHECK(refusal("local target = output('out', 'TimedLong')\nfunction on_execute()\n  if now() > 1e9 then "
                  "taget:write(1) end\nend") ==
          "robot_controller.lua:3:23: unknown global 'taget' (did you mean 'target'?)");
    CHECK(refusal("local function f() count = 1 end") ==
          "robot_controller.lua:1:20: unknown global 'count' (declare it first: local count)");
    CHECK(refusal("param('x', 1) pritn('x')") ==
          "robot_controller.lua:1:15: unknown global 'pritn' (did you mean 'print'?)");
    for (const std::string name :
         {"os", "io", "debug", "load", "loadstring", "dofile", "loadfile", "package", "collectgarbage", "_G"}) {
        CHECK(starts(refusal("param('x', 1) local y = " + name), 46) ==
              starts("robot_controller.lua:1:25: unknown global '" + name + "'", 46));
    }
}

TEST_CASE("words are not assigned", "[lua][refusals]") {
    for (const std::string name : {"state", "config", "input", "dt", "log", "math", "print"}) {
        CHECK(refusal("param('x', 1) " + name + " = 1") ==
              "robot_controller.lua:1:15: '" + name + "' can't be assigned: it is a word of its own (write 'local " +
                  name + "' for a variable of that name)");
    }
    CHECK(starts(refusal("param('x', 1) local _ENV = {}"), 26) == "robot_controller.lua:1:21:");
}

TEST_CASE("an unknown type names the nearest", "[lua][refusals]") {
    CHECK(refusal("output('out', 'TimedVelocity')") == at1 +
                                                           "output 'out': unknown type 'TimedVelocity' (did you mean "
                                                           "'TimedVelocity2D'?); `nezumi types` lists them all");
    CHECK(refusal("output('out', 3)") ==
          at1 + "output 'out': its type expected a string such as \"TimedVelocity2D\", got number");
}

TEST_CASE("a name is declared once", "[lua][refusals]") {
    CHECK(refusal("input('a', 'TimedLong')\ninput('a', 'TimedLong')") ==
          "robot_controller.lua:2: input 'a' is declared twice (first in line 1)");
    CHECK(refusal("input('a', 'TimedLong')\noutput('a', 'TimedLong')") ==
          "robot_controller.lua:2: output 'a': the name is taken by input 'a' (first in line 1)");
    CHECK(refusal("command('a', function() end)\ncommand('a', function() end)") ==
          "robot_controller.lua:2: command 'a' is declared twice (first in line 1)");
    CHECK(refusal("input('a', 'TimedLong')\ncommand('a', function() end)") ==
          "robot_controller.lua:2: command 'a': the name is taken by input 'a' (first in line 1)");
    CHECK(refusal("command('a', function() end)\ninput('a', 'TimedLong')") ==
          "robot_controller.lua:2: input 'a': the name is taken by command 'a' (first in line 1)");
    CHECK(refusal("input('a', 'TimedLong') param('a', 1)") == "");  // X.a and X.config.a
}

TEST_CASE("a name is an identifier and no word of its own", "[lua][refusals]") {
    CHECK(refusal("input('in', 'TimedLong')") == "");  // a keyword is a port's name: X.ports["in"]
    CHECK(refusal("param('end', 1)") == at1 + "parameter 'end': the name is no identifier: it is a keyword of Lua");
    CHECK(refusal("command('end', print)") == at1 + "command 'end': the name is no identifier: it is a keyword of Lua");
    for (const std::string name : {"", "1a", "a-b", "a b", "a.b", "\xC3\xA4"}) {
        CHECK(refusal("input('" + name + "', 'TimedLong')") ==
              at1 + "input '" + name + "': the name is no identifier: use letters, digits and _, no digit first");
        CHECK(refusal("param('" + name + "', 1)") ==
              at1 + "parameter '" + name + "': the name is no identifier: use letters, digits and _, no digit first");
    }
    for (const std::string name : {"config", "state", "status", "ports", "activate", "use", "now", "input", "require",
                                   "tasks", "probes", "task", "wait"}) {
        CHECK(refusal("output('" + name + "', 'TimedLong')") ==
              at1 + "output '" + name + "': the name is one of a component's own words: choose another, as 'my_" +
                  name + "'");
        CHECK(refusal("param('" + name + "', 1)") ==
              at1 + "parameter '" + name + "': the name is one of a component's own words: choose another, as 'my_" +
                  name + "'");
        CHECK(refusal("command('" + name + "', print)") ==
              at1 + "command '" + name + "': the name is one of a component's own words: choose another, as 'my_" +
                  name + "'");
    }
    CHECK(refusal("param('math', 1)") == at1 + "parameter 'math': the name is taken by Lua's library");
    CHECK(refusal("input('" + std::string(200, 'a') + "', 'TimedLong')") ==
          at1 + "input '" + std::string(60, 'a') + "...': the name is too long");
    CHECK(refusal("param('a\\nb\\0', 1)") ==
          at1 + "parameter 'a\\x0ab\\x00': the name is no identifier: use letters, digits and _, no digit first");
}

TEST_CASE("declarations are made while the file loads", "[lua][refusals]") {
    CHECK(failure_of("", "input('a', 'TimedLong')") ==
          "robot_controller.lua:3: input can only be called while the file loads");
    CHECK(failure_of("", "output('a', 'TimedLong')") ==
          "robot_controller.lua:3: output can only be called while the file loads");
    CHECK(failure_of("", "param('a', 1)") == "robot_controller.lua:3: param can only be called while the file loads");
    CHECK(failure_of("", "command('a', print)") ==
          "robot_controller.lua:3: command can only be called while the file loads");
    CHECK(failure_of("", "about {}") == "robot_controller.lua:3: about can only be called while the file loads");
}

TEST_CASE("an error at the top level refuses the file with its line", "[lua][refusals][watchdog]") {
    CHECK(refusal("param('x', 1)\nerror('no')") == "robot_controller.lua:2: no");
    CHECK(refusal("param('x', 1)\nlocal t = nil\nt.x = 1") ==
          "robot_controller.lua:3: attempt to index a nil value (local 't')");
    CHECK(refusal("param('x', 1)\nerror()") == "robot_controller.lua:2: an error of value nil");
    CHECK(refusal("param('x', 1)\nerror({})") == "robot_controller.lua:2: an error of type table");
    CHECK(refusal("param('x', 1)\nwhile true do end", {.budget = {0.02}}) ==
          "robot_controller.lua:2: ran for more than 0.02 s: is there an endless loop?");
    CHECK(refusal("local t = {}\nfor i = 1, 1e9 do t[i] = {} end", {.budget = {5}, .memory_limit = 1 << 20}) ==
          "robot_controller.lua:2: not enough memory: the script reached its limit of 1 MB");
}

TEST_CASE("a script that fails in any way ends in ERROR and nothing else does", "[lua][refusals][watchdog]") {
    for (const std::string body :
         {"error(nil)", "error({})", "assert(false)", "local t t.x = 1",
          "coroutine.wrap(function() error('inside') end)()", "while true do end",
          "pcall(function() while true do end end)", "coroutine.wrap(function() while true do end end)()",
          "local function f() return 1 + f() end f()", "local t = {} while true do t[#t + 1] = ('x'):rep(1e6) end",
          "local s = 'x' while true do s = s .. s end", "setmetatable({}, { __gc = function() while true do end end })",
          ";('a'):rep(32):find(('a?'):rep(32) .. ('a'):rep(32))", "string.rep('', 1 << 60)",
          "table.move({}, 1, 1 << 60, 2)", "table.unpack(setmetatable({}, { __len = function() return 1 << 60 end }))",
          "state.f.g = 1", "coroutine.yield()"}) {
        INFO(body);
        ScriptRig rig("local vel = output('vel', 'TimedVelocity2D')\nfunction on_execute() vel:write { vx = 1 }\n" +
                          body + "\nend",
                      {.budget = {0.05}, .memory_limit = 8 << 20});
        rig.activate().tick();
        CHECK(rig.status() == "ERROR");
        CHECK(starts(rig.error(), 23) == "robot_controller.lua:3:");
        CHECK(rig.out<Velocity2D>("vel").read() == Velocity2D{});
        rig.tick(3);
    }
}

TEST_CASE("an endless loop in any callback ends by its budget", "[lua][refusals][watchdog]") {
    for (const std::string hook :
         {"on_activated", "on_execute", "on_deactivated", "on_aborting", "on_error", "on_reset"}) {
        INFO(hook);
        ScriptRig rig("function " + hook + "() while true do end end\n" +
                          (hook == "on_execute" || hook == "on_activated" ? "" : "command('fail', print)\n") +
                          (hook == "on_execute"
                               ? ""
                               : "function on_execute() if config.fail then error('x') end end\nparam('fail', false)"),
                      {.budget = {0.02}});
        static_cast<void>(rig.component->activate(rig.now));
        static_cast<void>(rig.component->deactivate(rig.now));
        if (rig.status() == "INACTIVE") static_cast<void>(rig.component->activate(rig.now));
        if (rig.component->parameters().find("fail") != nullptr) REQUIRE(rig.component->parameters().set("fail", true));
        rig.tick(2);
        static_cast<void>(rig.component->reset(rig.now));
        bool said = false;
        for (const std::string& line : rig.log)
            said = said || line.find("ran for more than 0.02 s") != std::string::npos;
        CHECK((said || rig.error().find("ran for more than 0.02 s") != std::string::npos));
    }
}

TEST_CASE("a command can't be called like a member of components", "[lua][refusals]") {
    for (const std::string name : {"set", "truth", "rate", "teleport", "commands", "leds"}) {
        CHECK(refusal("command('" + name + "', function() end)") == "robot_controller.lua:1: command '" + name +
                                                                        "': components have a member '" + name +
                                                                        "' already: choose another name");
    }
    CHECK_THAT(refusal("command('status', function() end)"), Catch::Contains("is one of a component's own words"));
}

TEST_CASE("a component has at most 1000 ports, parameters and commands each, and says so", "[lua][component]") {
    CHECK(refusal("for i = 1, 1000 do param('x' .. i, 0) end") == "");
    CHECK(refusal("for i = 1, 30000 do param('x' .. i, 0) end") ==
          "robot_controller.lua:1: parameter 'x1001': a component has at most 1000 parameters");
    CHECK(refusal("for i = 1, 30000 do input('x' .. i, 'TimedLong') end") ==
          "robot_controller.lua:1: input 'x1001': a component has at most 1000 ports");
    CHECK(refusal("for i = 1, 30000 do command('x' .. i, function() end) end") ==
          "robot_controller.lua:1: command 'x1001': a component has at most 1000 commands");
}

TEST_CASE("a zero byte ends no name", "[lua][component]") {
    const ScriptContext context{.find_module = [](std::string_view name, std::string_view) -> Expected<SourceText> {
        return failure("there is no module '" + shown(name) + "'");
    }};
    CHECK(refusal("require 'a\\0b'", context) ==
          "robot_controller.lua:1: require 'a\\x00b': there is no module 'a\\x00b'");
    CHECK(failure_of("param('x', 1)", "config['x\\0y'] = 2").find("unknown parameter 'x\\x00y'") != std::string::npos);
    CHECK(failure_of("local a = input('a', 'TimedLong')", "local _ = a['tm\\0']").find("has no 'tm\\x00'") !=
          std::string::npos);
}
