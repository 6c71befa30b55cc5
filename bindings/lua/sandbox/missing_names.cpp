// The table of names.
#include "bindings/lua/sandbox/missing_names.hpp"

namespace nezumi {
namespace {

constexpr std::string_view no_loading = "code comes from files, by `require`";
constexpr std::string_view no_environments = "functions have no environment in Lua 5.4: pass values as arguments";
constexpr std::string_view no_collecting = "memory is released automatically";
constexpr std::string_view bits = "Lua 5.4 has operators for bits: & | ~ << >>";
constexpr std::string_view is_nil = "it is nil in Lua";

}  // namespace

const std::vector<Instead>& missing_names() {
    static const std::vector<Instead> names{
        {"load", no_loading},
        {"loadfile", no_loading},
        {"dofile", no_loading},
        {"loadstring", no_loading},
        {"module", no_loading},
        {"package", no_loading},
        {"string.dump", no_loading},
        {"getfenv", no_environments},
        {"setfenv", no_environments},
        {"collectgarbage", no_collecting},
        {"gcinfo", no_collecting},
        {"unpack", "it is table.unpack in Lua 5.4"},
        {"bit", bits},
        {"bit32", bits},
        {"math.atan2", "it is math.atan(y, x) in Lua 5.4"},
        {"math.cosh", "it is (math.exp(x) + math.exp(-x)) / 2 in Lua 5.4"},
        {"math.sinh", "it is (math.exp(x) - math.exp(-x)) / 2 in Lua 5.4"},
        {"math.tanh", "it is 1 - 2 / (math.exp(2 * x) + 1) in Lua 5.4"},
        {"math.frexp", "Lua 5.4 has none: math.log(x, 2) gives the exponent"},
        {"math.ldexp", "it is m * 2.0 ^ e in Lua 5.4"},
        {"math.log10", "it is math.log(x, 10) in Lua 5.4"},
        {"math.mod", "it is math.fmod(a, b) in Lua 5.4"},
        {"math.pow", "it is x ^ y in Lua 5.4"},
        {"math.round", "it is math.floor(x + 0.5) in Lua 5.4"},
        {"string.gfind", "it is string.gmatch in Lua 5.4"},
        {"table.foreach", "it is `for key, value in pairs(t) do` in Lua 5.4"},
        {"table.foreachi", "it is `for i, value in ipairs(t) do` in Lua 5.4"},
        {"table.getn", "it is #t in Lua 5.4"},
        {"table.maxn", "it is #t in Lua 5.4"},
        {"table.setn", "the length of a table follows its elements: t[#t] = nil takes the last one off"},
        {"None", is_nil},
        {"null", is_nil},
        {"undefined", is_nil},
        {"True", "it is true in Lua"},
        {"False", "it is false in Lua"},
    };
    return names;
}

}  // namespace nezumi
