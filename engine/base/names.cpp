// Lua's keywords and the console's words are taken.
#include "engine/base/names.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace nezumi {
namespace {

constexpr std::array<std::string_view, 22> lua_keywords{
    "and", "break", "do",  "else", "elseif", "end",    "false",  "for",  "function", "goto",  "if",
    "in",  "local", "nil", "not",  "or",     "repeat", "return", "then", "true",     "until", "while"};

// What the console and scenarios have in scope beside a system's names: product.md's words and the library's.
constexpr std::array<std::string_view, 50> console_words{
    "assert",  "attach",   "batch",    "connect",  "coroutine", "disconnect", "drive", "drop",    "error",  "errors",
    "find",    "freeze",   "help",     "hold",     "inject",    "ipairs",     "log",   "ls",      "math",   "next",
    "now",     "pairs",    "pause",    "pcall",    "plot",      "print",      "quit",  "release", "reload", "require",
    "restart", "restore",  "rollback", "run",      "save",      "select",     "speed", "step",    "string", "system",
    "table",   "teleport", "tonumber", "tostring", "type",      "unwatch",    "utf8",  "watch",   "world",  "xpcall"};

}  // namespace

bool is_identifier(std::string_view name) {
    if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front())) != 0) return false;
    const bool plain = std::all_of(name.begin(), name.end(),
                                   [](unsigned char c) { return c < 0x80 && (std::isalnum(c) != 0 || c == '_'); });
    return plain && std::find(lua_keywords.begin(), lua_keywords.end(), name) == lua_keywords.end();
}

bool is_reserved_name(std::string_view name) {
    return std::find(lua_keywords.begin(), lua_keywords.end(), name) != lua_keywords.end() ||
           std::find(console_words.begin(), console_words.end(), name) != console_words.end();
}

}  // namespace nezumi
