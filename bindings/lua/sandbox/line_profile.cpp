// A Lua hook for lines and returns. It calls nothing that raises an error or takes memory of the state, so the script
// runs as without it. Its time does not count for the measured calls.
#include "bindings/lua/sandbox/line_profile.hpp"

#include <exception>

#include "bindings/lua/sandbox/state.hpp"
#include "bindings/lua/sandbox/watchdog.hpp"

namespace nezumi {
namespace {

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): a hook finds its thread's profile by it
constinit thread_local LineProfile* current_profile = nullptr;

std::string_view file_of(const lua_Debug& function) {
    return *function.source == '@' ? function.source + 1 : function.short_src;
}

}  // namespace

std::size_t LineCosts::child(std::size_t parent, std::string_view name, std::string_view file, int line, bool is_line) {
    // A function and its first line may have the same line number, so functions have negative ones as keys.
    const std::pair key(parent, std::pair(std::string(file), is_line ? line : -line));
    const auto [found, is_new] = children_.try_emplace(key, nodes_.size());
    if (is_new) {
        nodes_.push_back(
            {.parent = parent, .name = std::string(name), .file = std::string(file), .line = line, .is_line = is_line});
    }
    return found->second;
}

LineProfile::LineProfile(LineCosts& costs)
    : costs_(costs), outer_(std::exchange(current_profile, this)), since_(thread_time()) {}

LineProfile::~LineProfile() {
    if (present_ != 0) costs_.add(present_, thread_time() - since_);
    current_profile = outer_;  // the hooks remove themselves
}

void LineProfile::follow(lua_State* coroutine) {
    if (current_profile != nullptr && has_free_hook(coroutine))
        lua_sethook(coroutine, on_event, LUA_MASKLINE | LUA_MASKRET, 0);
}

void LineProfile::on_event(lua_State* lua, lua_Debug* event) {
    LineProfile* const profile = current_profile;
    if (profile == nullptr) {
        // The watchdog may have set its own hook meanwhile, which must stay.
        if (lua_gethook(lua) == on_event) free_hook(lua);
        return;
    }
    if (LuaState::of(lua).is_doubled(lua, event)) return;
    const std::int64_t began = thread_time();
    if (profile->present_ != 0) profile->costs_.add(profile->present_, began - profile->since_);
    try {
        profile->note(lua, event);
    } catch (const std::exception&) {  // no memory; C++ exceptions must not cross Lua
        profile->present_ = 0;
    }
    profile->since_ = thread_time();
    profile->hooks_ += profile->since_ - began;
    charge_calls(began - profile->since_);
    look_at_time(lua);
}

void LineProfile::note(lua_State* lua, lua_Debug* event) {
    // After a return, the caller's line continues.
    const bool begins = event->event == LUA_HOOKLINE;
    const int innermost = begins ? 0 : 1;
    int depth = innermost;
    lua_Debug function;
    while (depth < deepest && lua_getstack(lua, depth + 1, &function) != 0) ++depth;
    std::size_t node = 0;
    std::size_t line = 0;
    for (int level = depth; level >= innermost; --level) {
        if (lua_getstack(lua, level, &function) == 0 || lua_getinfo(lua, "nSl", &function) == 0) continue;
        if (*function.what == 'C') continue;
        const std::string_view file = file_of(function);
        node = costs_.child(node, function.name != nullptr ? function.name : "", file, function.linedefined, false);
        line = function.currentline > 0 ? costs_.child(node, "", file, function.currentline, true) : 0;
    }
    present_ = line;
    if (begins && line != 0) costs_.begin(line);
}

}  // namespace nezumi
