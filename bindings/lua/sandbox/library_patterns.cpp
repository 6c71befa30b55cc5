// find, match, gmatch, gsub: convert arguments for the matcher, and results for Lua.
#include "bindings/lua/sandbox/library_patterns.hpp"

#include <cstring>
#include <string_view>

#include "bindings/lua/sandbox/pattern.hpp"
#include "bindings/lua/sandbox/watchdog.hpp"

namespace nezumi::library {
namespace {

std::string_view check_text(lua_State* lua, int index) {
    std::size_t length = 0;
    const char* text = luaL_checklstring(lua, index, &length);
    return {text, length};
}

// Raises the matcher's error, if there is one.
void check_matcher(lua_State* lua, const PatternMatcher& matcher) {
    if (matcher.error() != nullptr) luaL_error(lua, matcher.error(), matcher.error_number());
}

// Pushes capture `index`, counted from 0. In a pattern without captures, capture 0 is the whole match from `start` to
// `end`.
void push_capture(lua_State* lua, const PatternMatcher& matcher, int index, const char* start, const char* end) {
    if (index >= matcher.capture_count()) {
        if (index != 0) luaL_error(lua, "invalid capture index %%%d", index + 1);
        lua_pushlstring(lua, start, static_cast<std::size_t>(end - start));
        return;
    }
    const PatternCapture& capture = matcher.capture(index);
    switch (capture.kind) {
        case PatternCapture::Kind::text: lua_pushlstring(lua, capture.start, capture.length); break;
        case PatternCapture::Kind::position: lua_pushinteger(lua, capture.start - matcher.subject_begin() + 1); break;
        case PatternCapture::Kind::open: luaL_error(lua, "unfinished capture");
    }
}

int push_captures(lua_State* lua, const PatternMatcher& matcher, const char* start, const char* end) {
    const int count = matcher.capture_count() == 0 && start != nullptr ? 1 : matcher.capture_count();
    luaL_checkstack(lua, count, "too many captures");
    for (int i = 0; i < count; ++i) push_capture(lua, matcher, i, start, end);
    return count;
}

// Converts an argument that counts from 1, or from the end if negative, to an offset.
std::size_t start_offset(lua_Integer position, std::size_t length) {
    if (position > 0) return static_cast<std::size_t>(position) - 1;
    if (position == 0 || position < -static_cast<lua_Integer>(length)) return 0;
    return length - static_cast<std::size_t>(-position);
}

bool take_anchor(std::string_view& pattern) {
    if (pattern.empty() || pattern.front() != '^') return false;
    pattern.remove_prefix(1);
    return true;
}

int search(lua_State* lua, bool wants_place) {
    const std::string_view subject = check_text(lua, 1);
    std::string_view pattern = check_text(lua, 2);
    const std::size_t offset = start_offset(luaL_optinteger(lua, 3, 1), subject.size());
    if (offset > subject.size()) {
        lua_pushnil(lua);
        return 1;
    }
    const bool plain =
        wants_place && (lua_toboolean(lua, 4) != 0 || pattern.find_first_of("^$*+?.([%-") == pattern.npos);
    if (plain) {
        const char* from = subject.data() + offset;
        const void* found = memmem(from, subject.size() - offset, pattern.data(), pattern.size());
        if (found == nullptr) {
            lua_pushnil(lua);
            return 1;
        }
        const std::ptrdiff_t at = static_cast<const char*>(found) - subject.data();
        lua_pushinteger(lua, at + 1);
        lua_pushinteger(lua, at + static_cast<lua_Integer>(pattern.size()));
        return 2;
    }
    const bool anchored = take_anchor(pattern);
    PatternMatcher matcher(subject, pattern, current_call->pattern_steps);
    for (const char* start = subject.data() + offset; start <= matcher.subject_end(); ++start) {
        const char* end = matcher.match_at(start);
        check_matcher(lua, matcher);
        if (end != nullptr) {
            if (!wants_place) return push_captures(lua, matcher, start, end);
            lua_pushinteger(lua, start - subject.data() + 1);
            lua_pushinteger(lua, end - subject.data());
            return push_captures(lua, matcher, nullptr, nullptr) + 2;
        }
        if (anchored) break;
    }
    lua_pushnil(lua);
    return 1;
}

// Upvalues: subject, pattern, where to continue, end of the last match (or -1).
int next_match(lua_State* lua) {
    const std::string_view subject = check_text(lua, lua_upvalueindex(1));
    const std::string_view pattern = check_text(lua, lua_upvalueindex(2));
    const lua_Integer last_end = lua_tointeger(lua, lua_upvalueindex(4));
    PatternMatcher matcher(subject, pattern, current_call->pattern_steps);
    const char* start = subject.data() + lua_tointeger(lua, lua_upvalueindex(3));
    for (; start <= matcher.subject_end(); ++start) {
        const char* end = matcher.match_at(start);
        check_matcher(lua, matcher);
        if (end == nullptr || end - subject.data() == last_end) continue;
        lua_pushinteger(lua, end - subject.data());
        lua_copy(lua, -1, lua_upvalueindex(3));
        lua_replace(lua, lua_upvalueindex(4));
        return push_captures(lua, matcher, start, end);
    }
    return 0;
}

// Appends the replacement text, with %0 to %9 replaced.
void add_replacement_text(lua_State* lua, luaL_Buffer& buffer, const PatternMatcher& matcher, const char* start,
                          const char* end) {
    std::size_t length = 0;
    const char* text = lua_tolstring(lua, 3, &length);
    const char* const text_end = text + length;
    while (text < text_end) {
        const auto* escape =
            static_cast<const char*>(std::memchr(text, '%', static_cast<std::size_t>(text_end - text)));
        if (escape == nullptr) escape = text_end;
        luaL_addlstring(&buffer, text, static_cast<std::size_t>(escape - text));
        if (escape == text_end) return;
        const char which = escape + 1 < text_end ? escape[1] : '\0';
        text = escape + 2;
        if (which == '%') {
            luaL_addchar(&buffer, '%');
        } else if (which == '0') {
            luaL_addlstring(&buffer, start, static_cast<std::size_t>(end - start));
        } else if (which >= '1' && which <= '9') {
            push_capture(lua, matcher, which - '1', start, end);
            luaL_addvalue(&buffer);
        } else {
            luaL_error(lua, "invalid use of '%c' in replacement string", '%');
        }
    }
}

// Appends the replacement of the match; returns whether it differs from the match.
bool add_replacement(lua_State* lua, luaL_Buffer& buffer, const PatternMatcher& matcher, const char* start,
                     const char* end) {
    switch (lua_type(lua, 3)) {
        case LUA_TFUNCTION:
            lua_pushvalue(lua, 3);
            lua_call(lua, push_captures(lua, matcher, start, end), 1);
            break;
        case LUA_TTABLE:
            push_capture(lua, matcher, 0, start, end);
            lua_gettable(lua, 3);
            break;
        default: add_replacement_text(lua, buffer, matcher, start, end); return true;
    }
    if (lua_toboolean(lua, -1) == 0) {
        lua_pop(lua, 1);
        luaL_addlstring(&buffer, start, static_cast<std::size_t>(end - start));
        return false;
    }
    if (lua_isstring(lua, -1) == 0) luaL_error(lua, "invalid replacement value (a %s)", luaL_typename(lua, -1));
    luaL_addvalue(&buffer);
    return true;
}

}  // namespace

int find_pattern(lua_State* lua) { return search(lua, true); }

int match_pattern(lua_State* lua) { return search(lua, false); }

int match_all(lua_State* lua) {
    const std::string_view subject = check_text(lua, 1);
    check_text(lua, 2);
    std::size_t offset = start_offset(luaL_optinteger(lua, 3, 1), subject.size());
    if (offset > subject.size()) offset = subject.size() + 1;  // no match
    lua_settop(lua, 2);
    lua_pushinteger(lua, static_cast<lua_Integer>(offset));
    lua_pushinteger(lua, -1);
    lua_pushcclosure(lua, next_match, 4);
    return 1;
}

int substitute(lua_State* lua) {
    const std::string_view subject = check_text(lua, 1);
    std::string_view pattern = check_text(lua, 2);
    const int type = lua_type(lua, 3);
    luaL_argexpected(lua, type == LUA_TNUMBER || type == LUA_TSTRING || type == LUA_TFUNCTION || type == LUA_TTABLE, 3,
                     "string/function/table");
    const lua_Integer most = luaL_optinteger(lua, 4, static_cast<lua_Integer>(subject.size()) + 1);
    const bool anchored = take_anchor(pattern);
    PatternMatcher matcher(subject, pattern, current_call->pattern_steps);
    const char* rest = subject.data();
    const char* last_end = nullptr;
    lua_Integer count = 0;
    bool changed = false;
    luaL_Buffer buffer;
    luaL_buffinit(lua, &buffer);
    while (count < most) {
        poll_budget(lua);
        const char* end = matcher.match_at(rest);
        check_matcher(lua, matcher);
        if (end != nullptr && end != last_end) {
            ++count;
            changed |= add_replacement(lua, buffer, matcher, rest, end);
            rest = last_end = end;
        } else if (rest < matcher.subject_end()) {
            luaL_addchar(&buffer, *rest);
            ++rest;
        } else {
            break;
        }
        if (anchored) break;
    }
    if (changed) {
        luaL_addlstring(&buffer, rest, static_cast<std::size_t>(matcher.subject_end() - rest));
        luaL_pushresult(&buffer);
    } else {
        lua_pushvalue(lua, 1);
    }
    lua_pushinteger(lua, count);
    return 2;
}

}  // namespace nezumi::library
