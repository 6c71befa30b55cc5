// Reads the stack of a coroutine from the innermost function to the outermost.
#include "bindings/lua/sandbox/error_frames.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "bindings/lua/sandbox/line_trace.hpp"
#include "bindings/lua/sandbox/text.hpp"
#include "bindings/lua/syntax/array_loops.hpp"

namespace nezumi {
namespace {

constexpr int searched_calls = 100;
constexpr int needed_slots = 8;

// The value on top of the stack; nothing if it has no text.
Value value_of(lua_State* lua) {
    switch (lua_type(lua, -1)) {
        case LUA_TBOOLEAN: return lua_toboolean(lua, -1) != 0;
        case LUA_TNUMBER:
            if (lua_isinteger(lua, -1) != 0) return std::int64_t{lua_tointeger(lua, -1)};
            return number_at(lua, -1);
        case LUA_TSTRING: {
            std::size_t size = 0;
            const char* const text = lua_tolstring(lua, -1, &size);
            return std::string(text, std::min(size, longest_local));
        }
        case LUA_TTABLE: return traced_text(lua);
        default: return {};
    }
}

}  // namespace

void add_variable(std::vector<ErrorFrames::Variable>& variables, lua_State* lua, const char* name) {
    Value value = value_of(lua);
    if (is_hidden(name) || (value.is_nothing() && lua_type(lua, -1) != LUA_TNIL)) return;
    ErrorFrames::Variable variable{name, traced_text(lua), std::move(value)};
    // If two variables have the same name, the inner one is used, which comes later.
    const auto same =
        std::find_if(variables.begin(), variables.end(), [&](const auto& each) { return each.name == variable.name; });
    if (same != variables.end()) {
        *same = std::move(variable);
    } else if (variables.size() < static_cast<std::size_t>(most_locals)) {
        variables.push_back(std::move(variable));
    }
}

namespace {

ErrorFrames::Frame frame_of(lua_State* lua, lua_Debug& activation, bool with_locals) {
    const char* const file = *activation.source == '@' ? activation.source + 1 : activation.short_src;
    ErrorFrames::Frame frame{
        .file = file, .line = activation.currentline, .name = activation.name != nullptr ? activation.name : ""};
    for (int i = 1; with_locals; ++i) {
        const char* const name = lua_getlocal(lua, &activation, i);
        if (name == nullptr) break;
        add_variable(frame.locals, lua, name);
        lua_pop(lua, 1);
    }
    std::sort(frame.locals.begin(), frame.locals.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    return frame;
}

// The error that a coroutine raised and its caller raises again.
struct InnerError {
    const void* error = nullptr;  // only compared
    std::shared_ptr<const ErrorFrames> frames{};
};

InnerError& inner_error() {
    static thread_local InnerError the_error;
    return the_error;
}

// The frames of `coroutine`. If `error` is the inner error, raised again, the frames of that come first.
std::shared_ptr<const ErrorFrames> frames_from(lua_State* coroutine, bool is_deep, const void* error) {
    const bool with_locals = !is_deep && lua_checkstack(coroutine, needed_slots) != 0;
    const auto most = static_cast<std::size_t>(is_deep ? most_deep_frames : most_frames);
    ErrorFrames frames;
    if (const InnerError& inner = inner_error(); inner.frames != nullptr && inner.error == error)
        frames = *inner.frames;
    lua_Debug activation;
    for (int level = 0;
         level < searched_calls && frames.all.size() < most && lua_getstack(coroutine, level, &activation) != 0;
         ++level) {
        if (lua_getinfo(coroutine, "nSl", &activation) != 0 && activation.currentline > 0)
            frames.all.push_back(frame_of(coroutine, activation, with_locals));
    }
    return frames.all.empty() ? nullptr : std::make_shared<const ErrorFrames>(std::move(frames));
}

}  // namespace

std::shared_ptr<const ErrorFrames> frames_of(lua_State* coroutine, bool is_deep) {
    return frames_from(coroutine, is_deep, lua_topointer(coroutine, -1));
}

void note_inner_error(lua_State* lua, lua_State* coroutine) {
    constexpr int deep_recursion = 20'000;  // number of nested calls
    lua_Debug activation;
    const void* const error = lua_topointer(lua, -1);
    auto frames = frames_from(coroutine, lua_getstack(coroutine, deep_recursion, &activation) != 0, error);
    inner_error() = {error, std::move(frames)};
}

void forget_inner_error() { inner_error() = {}; }

}  // namespace nezumi
