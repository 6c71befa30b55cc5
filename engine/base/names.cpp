// Lua's keywords and other names that components can't have.
#include "engine/base/names.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace nezumi {
namespace {

constexpr std::array<std::string_view, 22> keywords{
    "and", "break", "do",  "else", "elseif", "end",    "false",  "for",  "function", "goto",  "if",
    "in",  "local", "nil", "not",  "or",     "repeat", "return", "then", "true",     "until", "while"};

constexpr std::array<std::string_view, 115> words{
    "_ENV",       "about",         "activate", "allow_error", "always",    "any",       "arena",      "argument",
    "attach",     "batch",         "behavior", "box",         "branches",  "break_at",  "cancel",     "check",
    "command",    "component",     "config",   "connect",     "constants", "coroutine", "csv",        "cylinder",
    "deactivate", "disconnect",    "disturb",  "drive",       "drop",      "dt",        "equal",      "errors",
    "eventually", "exit",          "explain",  "find",        "floor",     "freeze",    "golden",     "graph",
    "help",       "hold",          "hosts",    "inject",      "input",     "judge",     "line",       "load",
    "log",        "log_level",     "ls",       "maintain",    "map",       "marker",    "math",       "maze",
    "measure",    "message",       "near",     "network",     "never",     "new",       "now",        "output",
    "param",      "pause",         "physics",  "picture",     "plot",      "press",     "print",      "probe",
    "profile",    "quit",          "range",    "rate",        "rearm",     "recorded",  "release",    "reload",
    "remove",     "require",       "restart",  "restore",     "resume",    "rewind",    "robot",      "robot_model",
    "rollback",   "ros",           "rtm",      "run",         "samples",   "save",      "scenario",   "seed",
    "seek",       "speed",         "start",    "state",       "step",      "stop",      "string",     "system",
    "table",      "task",          "teleport", "unwatch",     "utf8",      "wait",      "wait_until", "wall",
    "watch",      "watch_changes", "world"};

static_assert(std::is_sorted(keywords.begin(), keywords.end()) && std::is_sorted(words.begin(), words.end()));

}  // namespace

std::span<const std::string_view> lua_keywords() { return keywords; }

bool is_keyword(std::string_view name) { return std::binary_search(keywords.begin(), keywords.end(), name); }

bool is_identifier(std::string_view name) {
    if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front())) != 0) return false;
    const bool plain = std::all_of(name.begin(), name.end(),
                                   [](unsigned char c) { return c < 0x80 && (std::isalnum(c) != 0 || c == '_'); });
    return plain && !is_keyword(name);
}

std::span<const std::string_view> promised_words() { return words; }

bool is_reserved_name(std::string_view name) {
    return is_keyword(name) || std::binary_search(words.begin(), words.end(), name);
}

}  // namespace nezumi
