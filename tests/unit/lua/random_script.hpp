// Behaviours made at random from a grammar of Lua and of the words of behaviours: most load, and do what nobody would.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace nezumi {

class RandomScript {
public:
    /// The same seed gives the same text.
    explicit RandomScript(std::uint64_t seed) : random_(seed) {}

    std::string text() {
        std::string script = "local range = input('in', 'TimedShortSeq', '', { queue = " + pick({"1", "5"}) +
                             " })\nlocal target = output('out', 'TimedVelocity2D'" +
                             pick({"", ", '', { safe = { vx = 0.1 } }", ", '', { safe = {} }"}) +
                             ")\nlocal flag = output('flag', 'TimedBoolean'" + pick({"", ", '', { safe = true }"}) +
                             ")\n" + modules() + "param('x', " + pick({"0", "0.5", "true", "'text'", "{ 1.0, 2.0 }"}) +
                             ")\nparam('speed', 0.2, { min = -1.0, max = 1.0 })\nlocal a, b, c = 1, {}, 'c'\n"
                             "local function twice(f, ...) return f(...), f(...) end\n";
        if (one_in(3)) script += "command('go', function(a, b) " + block(2) + " return a, " + value(2) + " end)\n";
        for (const char* name : {"'one'", "'two'"}) {
            if (one_in(3)) script += task(name);
        }
        for (const char* hook :
             {"on_activated", "on_execute", "on_deactivated", "on_aborting", "on_error", "on_reset", "on_reload"}) {
            const bool always = std::string(hook) == "on_execute";
            if (always || one_in(4)) script += std::string("function ") + hook + "(...)\n" + body() + "end\n";
        }
        return script;
    }

    /// A module that behaviours require by the name of "part".
    static const char* module() {
        return "local M = {}\nfunction M.twice(f, ...) return f(...), f(...) end\n"
               "function M.later(seconds) wait(seconds) return now() end\nM.list = { 1, 2, 3 }\nreturn M\n";
    }

private:
    std::string modules() {
        if (!one_in(3)) return "local part = {}\n";
        return pick({"local part = require 'part'\n", "local part = require 'nezumi.filters'\n",
                     "local part = require 'nezumi.state_machine'\n",
                     "local _, part = pcall(require, 'no.such.module')\n",
                     "local part = require 'part' part.list[4] = require 'part'\n"});
    }

    std::string task(const std::string& name) {
        return "task(" + name + ", function(...)\n" + body() + pick({"", "wait(0.02) "}) + block(2) + "end" +
               pick({"", ", { repeating = true }"}) + ")\n";
    }

    // Fails where no task runs, as in most hooks.
    std::string waiting(int depth) {
        switch (std::uniform_int_distribution<int>(0, 3)(random_)) {
            case 0: return "wait(" + pick({"0", "0.01", "0.05", "-1", "1e9", "0/0", "'x'"}) + ")";
            case 1: return "wait(" + value(depth - 1) + ")";
            case 2:
                return "wait_until(function() " + block(depth - 2) + " return " + value(depth - 1) + " end" +
                       pick({"", ", { within = 0.05 }", ", { within = 0 }"}) + ")";
            default: return "part.later(0.01)";
        }
    }

    bool one_in(int n) { return std::uniform_int_distribution<int>(1, n)(random_) == 1; }
    std::string pick(const std::vector<const char*>& choices) {
        return choices[std::uniform_int_distribution<std::size_t>(0, choices.size() - 1)(random_)];
    }

    // Most of what goes wrong is caught, or nothing would come after it.
    std::string body() {
        std::string text;
        for (int count = std::uniform_int_distribution<int>(1, 5)(random_); count > 0; --count)
            text += one_in(8) ? statement(4) + "\n" : "pcall(function() " + statement(4) + " end)\n";
        return text;
    }

    std::string block(int depth) {
        std::string text;
        for (int count = std::uniform_int_distribution<int>(0, 4)(random_); count >= 0; --count)
            text += statement(depth) + "\n";
        return text;
    }

    std::string variable() { return pick({"a", "b", "c"}); }

    std::string place(int depth) {
        switch (std::uniform_int_distribution<int>(0, 5)(random_)) {
            case 0: return "config.speed";
            case 1: return "config.x";
            case 2: return "state." + pick({"n", "list", "deep"});
            case 3: return "b[" + value(depth - 1) + "]";
            default: return variable();
        }
    }

    std::string statement(int depth) {
        if (depth <= 0) return place(0) + " = " + value(0);
        switch (std::uniform_int_distribution<int>(0, 21)(random_)) {
            case 0:
                return "if " + value(depth - 1) + " then " + block(depth - 1) + " else " + block(depth - 1) + " end";
            case 1:
                return "for i = 1, " + pick({"3", "10", "1000", "1e7", "-1", "0.5"}) + " do " + block(depth - 1) +
                       " end";
            case 2: return "for k, v in pairs(" + table(depth - 1) + ") do " + block(depth - 1) + " end";
            case 3: return "for _, v in ipairs(range:read()) do a = v " + block(depth - 2) + " end";
            case 4:
                return one_in(6) ? "while true do " + block(depth - 2) + " end"
                                 : "repeat " + block(depth - 1) + " until true";
            case 5:
            case 6: return "target:write { vx = " + value(depth - 1) + ", va = " + value(depth - 1) + " }";
            case 7: return "target:write { vx = " + pick({"0.1", "0.5", "-0.3", "1e9", "0/0"}) + " }";
            case 8: return "flag:write(" + value(depth - 1) + ")";
            case 9:
                return pick({"log.info", "log.warn", "print"}) + "(" + value(depth - 1) + ", " + value(depth - 1) + ")";
            case 10: return one_in(3) ? "error(" + value(depth - 1) + ")" : "pcall(error, " + value(depth - 1) + ")";
            case 11: return "local " + variable() + " = " + value(depth - 1);
            case 12: return "local t <close> = setmetatable({}, { __close = function() " + block(depth - 2) + " end })";
            case 13:
                return "coroutine.wrap(function(...) " + block(depth - 2) + " coroutine.yield(" + value(1) + ") end)()";
            case 14:
                return "do local ok, message = pcall(function() " + block(depth - 1) + " end) state.n = message end";
            case 15:
                return "table.sort(" + table(depth - 1) +
                       pick({"", ", function(x, y) return x < y end", ", function() return true end"}) + ")";
            case 16: return waiting(depth);
            case 17: return pick({"start", "cancel"}) + "(" + pick({"'one'", "'two'", "'none'", "a"}) + ")";
            case 18: return "probe(" + pick({"'p'", "'q'", "c", "'a b'"}) + ", " + value(depth - 1) + ")";
            case 19: return "part.list, part.n = " + value(depth - 1) + ", " + value(depth - 1);
            default: return place(depth) + " = " + value(depth - 1);
        }
    }

    std::string value(int depth) {
        if (depth <= 0)
            return pick({"nil",
                         "true",
                         "false",
                         "0",
                         "1",
                         "-1",
                         "30",
                         "2^53",
                         "1e308",
                         "math.huge",
                         "0/0",
                         "-0.0",
                         "''",
                         "'text'",
                         "'\\0\\27[31m\\n'",
                         "a",
                         "b",
                         "c",
                         "dt",
                         "now()",
                         "range.is_new",
                         "range.tm",
                         "range.age",
                         "config.x",
                         "config.speed",
                         "state.n",
                         "math.maxinteger",
                         "math.mininteger"});
        switch (std::uniform_int_distribution<int>(0, 13)(random_)) {
            case 0: return table(depth - 1);
            case 1: return "function(...) " + block(depth - 2) + " return ... end";
            case 2:
                return "(" + value(depth - 1) +
                       pick({" + ", " - ", " * ", " / ", " // ", " % ", " ^ ", " .. ", " == ", " < ", " <= ", " and ",
                             " or ", " & ", " << "}) +
                       value(depth - 1) + ")";
            case 3: return pick({"-", "not ", "#", "~"}) + "(" + value(depth - 1) + ")";
            case 4: return "range:read()" + pick({"", "[1]", "[99]"});
            case 5: return pick({"tostring", "tonumber", "type", "#"}) + "(" + value(depth - 1) + ")";
            case 6: return text_call(depth - 1);
            case 7:
                return pick({"table.concat", "table.unpack", "next", "rawlen", "getmetatable"}) + "(" +
                       table(depth - 1) + ")";
            case 8:
                return pick({"math.floor", "math.random", "math.sqrt", "math.tointeger", "math.abs"}) + "(" +
                       value(depth - 1) + ")";
            case 9:
                return "pcall(" + pick({"twice", "error", "range.read", "string.rep", "setmetatable", "tostring"}) +
                       ", " + value(depth - 1) + ", " + value(depth - 1) + ")";
            case 10:
                return "setmetatable({}, { " +
                       pick({"__index", "__newindex", "__call", "__tostring", "__len", "__eq", "__lt", "__concat",
                             "__pairs", "__metatable", "__close", "__name"}) +
                       " = " + value(depth - 1) + " })";
            default: return value(0);
        }
    }

    std::string text_call(int depth) {
        switch (std::uniform_int_distribution<int>(0, 4)(random_)) {
            case 0: return "string.rep(" + value(depth - 1) + ", " + pick({"3", "1000", "1e6", "1 << 60", "-1"}) + ")";
            case 1:
                return "string.format(" + pick({"'%d'", "'%s'", "'%5.1f'", "'%q'", "'%99d'"}) + ", " +
                       value(depth - 1) + ")";
            case 2:
                return "('abc'):gsub(" + pick({"'.'", "'%w+'", "'(a)(b)'", "'%f[%w]'", "'['"}) + ", " +
                       value(depth - 1) + ")";
            // Long ones took half of all time.
            case 3:
                return "('x'):rep(" + pick({"30", "100", "100", "3000"}) + "):find(" +
                       pick({"'.-.-.-.-b'", "('x?'):rep(30)", "'x'"}) + ")";
            default: return "('%s'):" + pick({"upper", "len", "byte", "reverse"}) + "()";
        }
    }

    std::string table(int depth) {
        if (depth <= 0) return pick({"{}", "b", "{ 1, 2, 3 }", "{ n = 1 }", "state", "range:read()", "config"});
        return "{ " + value(depth - 1) + ", " + value(depth - 1) + ", key = " + value(depth - 1) + " }";
    }

    std::mt19937_64 random_;
};

}  // namespace nezumi
