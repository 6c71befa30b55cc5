// Arithmetic of rates, and names that are free.
#include "engine/system_spec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

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

constexpr double most_steps = 1e6;  // of physics in a tick

// Wide enough for a tick number times a rate; not of ISO C++, which -Wpedantic wants to hear.
__extension__ using Wide = __int128;

// Rates as whole micro-hertz, so that "due" is exact.
Wide micro(double rate) { return static_cast<Wide>(std::llround(rate * 1e6)); }

}  // namespace

const std::string& name_of(const Entry& entry) {
    return std::visit([](const auto& e) -> const std::string& { return e.name; }, entry);
}

const Place& place_of(const Entry& entry) {
    return std::visit([](const auto& e) -> const Place& { return e.place; }, entry);
}

Expected<int> steps_per_tick(double rate, double physics_step) {
    if (!std::isfinite(rate) || rate <= 0) return failure(fmt::format("rate: {} Hz is not a positive number", rate));
    if (!std::isfinite(physics_step) || physics_step <= 0) {
        return failure(fmt::format("physics: a step of {} s is not a positive number", physics_step));
    }
    const double steps = 1.0 / (rate * physics_step);
    const double whole = std::round(steps);
    if (whole >= 1 && whole <= most_steps && std::abs(steps - whole) < 1e-9 * whole) return static_cast<int>(whole);
    // In full: a person may copy it.
    const auto rate_of = [&](double n) { return fmt::format("{}", 1.0 / (n * physics_step)); };
    const double slower = std::clamp(std::ceil(steps), 1.0, most_steps);
    const double faster = std::clamp(std::floor(steps), 1.0, most_steps);
    const std::string nearest =
        slower == faster ? fmt::format("the nearest rate is {} Hz", rate_of(slower))
                         : fmt::format("the nearest rates are {} or {} Hz", rate_of(slower), rate_of(faster));
    return failure(fmt::format("rate: a tick of {} Hz is no whole number of physics steps of {} s{}; {}", rate,
                               physics_step, steps > most_steps ? fmt::format(" up to {}", most_steps) : "", nearest));
}

bool is_due(std::int64_t k, double rate, double tick_rate) {
    if (rate <= 0 || rate >= tick_rate || k == 0) return true;
    const Wide component = micro(rate);
    const Wide tick = micro(tick_rate);
    return (k * component) / tick > ((k - 1) * component) / tick;
}

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
