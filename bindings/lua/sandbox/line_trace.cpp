// A Lua hook for lines and returns. It calls nothing that raises an error or takes memory of the state, so the script
// runs as without it. Its time does not count for the traced calls.
#include "bindings/lua/sandbox/line_trace.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "bindings/lua/sandbox/error_frames.hpp"
#include "bindings/lua/sandbox/line_profile.hpp"
#include "bindings/lua/sandbox/locked_table.hpp"
#include "bindings/lua/sandbox/state.hpp"
#include "bindings/lua/sandbox/text.hpp"
#include "bindings/lua/sandbox/watchdog.hpp"
#include "bindings/lua/syntax/array_loops.hpp"

namespace nezumi {
namespace {

constexpr int most_elements = 6;
constexpr int most_sorted = 1000;  // fields of a table: more would take too long
// Lines of installed modules are skipped, because the user has not written them.
constexpr std::string_view installed_modules = "behaviors/lib/nezumi/";

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): a hook finds its thread's trace by it
constinit thread_local LineTrace* current_trace = nullptr;

std::string cut(std::string text) {
    if (text.size() <= LineTrace::longest_value) return text;
    text.resize(LineTrace::longest_value - 3);
    return text.append("...");
}

// Shows control characters as dots, so that a value stays in its line.
std::string without_controls(std::string_view text) {
    std::string shown;
    for (const char each : text.substr(0, LineTrace::longest_value)) {
        const bool is_plain = static_cast<unsigned char>(each) >= ' ' && each != '\x7f';
        shown += is_plain ? each : '.';
    }
    return shown;
}

std::string text_of_string(std::string_view text) { return "\"" + without_controls(text) + "\""; }

// The value on top of the stack as text; "" for values without a text, such as functions.
std::string text_of(lua_State* lua, bool within = false);

// The fields with string keys of the table on top of the stack, except values without a text. Sorted by name, because
// the order in memory depends on the run. Nothing if the table has too many elements: which come first depends on it
// too.
std::optional<std::map<std::string, std::string>> named_fields(lua_State* lua, bool within) {
    std::map<std::string, std::string> fields;
    int count = 0;
    lua_pushnil(lua);
    while (lua_next(lua, -2) != 0) {
        if (++count > most_sorted) {
            lua_pop(lua, 2);
            return std::nullopt;
        }
        std::string value = lua_type(lua, -2) == LUA_TSTRING ? text_of(lua, within) : "";
        if (!value.empty()) fields.emplace(without_controls(lua_tostring(lua, -2)), std::move(value));
        lua_pop(lua, 1);
    }
    return fields;
}

std::string text_of_table(lua_State* lua) {
    std::string text = "{";
    int count = 0;
    const auto add = [&](const std::string& element) {
        if (!element.empty()) text += (count++ > 0 ? ", " : " ") + element;
    };
    const auto length = static_cast<lua_Integer>(lua_rawlen(lua, -1));
    for (lua_Integer i = 1; i <= length && count < most_elements; ++i) {
        lua_rawgeti(lua, -1, i);
        add(text_of(lua, true));
        lua_pop(lua, 1);
    }
    bool has_more = length > most_elements;
    if (length == 0) {
        const auto fields = named_fields(lua, true);
        if (!fields) return "{ ... }";
        for (const auto& [name, value] : *fields) {
            has_more = count >= most_elements;
            if (has_more) break;
            add(std::string(name).append(" = ").append(value));
        }
    }
    return text + (has_more ? ", ... }" : count > 0 ? " }" : "}");
}

std::string text_of(lua_State* lua, bool within) {
    switch (lua_type(lua, -1)) {
        case LUA_TNIL: return "nil";
        case LUA_TBOOLEAN: return lua_toboolean(lua, -1) != 0 ? "true" : "false";
        case LUA_TNUMBER: {
            char text[40];
            if (lua_isinteger(lua, -1) != 0) {
                std::snprintf(text, sizeof text, "%lld", static_cast<long long>(lua_tointeger(lua, -1)));
            } else {
                std::snprintf(text, sizeof text, "%.6g", number_at(lua, -1));
            }
            return text;
        }
        case LUA_TSTRING: {
            std::size_t length = 0;
            const char* const text = lua_tolstring(lua, -1, &length);
            return cut(text_of_string({text, length}));
        }
        case LUA_TTABLE: {
            if (within) return "{...}";
            const bool is_locked = push_behind_lock(lua, -1);
            std::string text = cut(text_of_table(lua));
            if (is_locked) lua_pop(lua, 1);
            return text;
        }
        default: return "";
    }
}

void put(std::vector<LineTrace::Value>& values, LineTrace::Value value) {
    const auto same =
        std::find_if(values.begin(), values.end(), [&](const auto& each) { return each.name == value.name; });
    if (same != values.end()) {
        same->text = std::move(value.text);
    } else if (values.size() < LineTrace::most_values) {
        values.push_back(std::move(value));
    }
}

// If two variables have the same name, the inner one is used, which comes later.
void add_value(std::vector<LineTrace::Value>& values, lua_State* lua, const char* name) {
    std::string text = text_of(lua);
    if (!text.empty()) put(values, {name, std::move(text)});
}

// The fields of the table on top of the stack: "state.count" and so on.
void add_fields(std::vector<LineTrace::Value>& values, lua_State* lua, const char* name) {
    if (lua_type(lua, -1) != LUA_TTABLE) return;
    const auto fields = named_fields(lua, false);
    if (!fields) return;
    int count = 0;
    for (const auto& [field, text] : *fields) {
        if (count++ >= LineTrace::most_fields) return;
        put(values, {std::string(name) + "." + field, text});
    }
}

int depth_of(lua_State* lua) {
    lua_Debug activation;
    int depth = 0;
    while (depth <= LineTrace::deepest && lua_getstack(lua, depth + 1, &activation) != 0) ++depth;
    return depth;
}

}  // namespace

std::string traced_text(lua_State* lua) { return text_of(lua); }

bool is_file(std::string_view source, std::string_view name) {
    if (!source.ends_with(name)) return false;
    source.remove_suffix(name.size());
    return source.empty() || source.back() == '/' || source.back() == '@';
}

LineTrace::LineTrace(std::vector<Table> tables, std::vector<Watched> watched)
    : outer_(std::exchange(current_trace, this)), tables_(std::move(tables)), watched_(std::move(watched)) {}

LineTrace::~LineTrace() {
    current_trace = outer_;  // the hooks remove themselves
}

void LineTrace::follow(lua_State* coroutine) {
    if (current_trace != nullptr && has_free_hook(coroutine))
        lua_sethook(coroutine, on_event, LUA_MASKLINE | LUA_MASKRET, 0);
    LineProfile::follow(coroutine);
}

void LineTrace::on_event(lua_State* lua, lua_Debug* event) {
    LineTrace* const trace = current_trace;
    if (trace == nullptr || trace->is_over()) {
        // The watchdog may have set its own hook meanwhile, which must stay.
        if (lua_gethook(lua) == on_event) free_hook(lua);
        return;
    }
    if (LuaState::of(lua).is_doubled(lua, event)) return;
    const std::int64_t began = thread_time();
    try {
        trace->note(lua, event);
    } catch (const std::exception&) {  // no memory; C++ exceptions must not cross Lua
        trace->seen_.is_cut = true;
    }
    charge_calls(began - thread_time());
    look_at_time(lua);
}

void LineTrace::note(lua_State* lua, lua_Debug* event) {
    if (!watched_.empty()) note_hit(lua, event);
    if (++events_ > most_events) seen_.is_cut = true;
    if (seen_.is_cut || lua_getinfo(lua, "Slf", event) == 0) return;
    const int depth = depth_of(lua);
    if (*event->what != 'C' && depth <= deepest) {
        const void* const function = lua_topointer(lua, -1);
        end_line(lua, event, depth, function);
        const bool is_installed = std::string_view(event->source).find(installed_modules) != std::string_view::npos;
        if (event->event == LUA_HOOKLINE && !is_installed) {
            if (seen_.lines.size() < most_lines) {
                const char* const file = *event->source == '@' ? event->source + 1 : event->short_src;
                frames_.push_back({lua, depth, function, seen_.lines.size()});
                seen_.lines.push_back(
                    {.file = file, .line = event->currentline, .depth = depth, .values = values_in_sight(lua, event)});
                fold_loop();
            } else {
                seen_.is_cut = true;
            }
        }
    }
    lua_pop(lua, 1);  // the function
}

void LineTrace::note_hit(lua_State* lua, lua_Debug* event) {
    if (event->event != LUA_HOOKLINE || hits_.size() >= most_hits) return;
    const auto is_here = [&](const Watched& each) { return each.line == event->currentline; };
    if (std::none_of(watched_.begin(), watched_.end(), is_here) || lua_getinfo(lua, "Sf", event) == 0) return;
    const bool is_watched = std::any_of(watched_.begin(), watched_.end(), [&](const Watched& each) {
        return is_here(each) && is_file(event->source, each.file);
    });
    if (is_watched) {
        Hit hit{.file = *event->source == '@' ? event->source + 1 : event->short_src, .line = event->currentline};
        for (int i = 1; const char* name = lua_getupvalue(lua, -1, i); ++i) {
            if (std::string_view(name) != "_ENV") add_variable(hit.variables, lua, name);
            lua_pop(lua, 1);
        }
        for (int i = 1; const char* name = lua_getlocal(lua, event, i); ++i) {
            add_variable(hit.variables, lua, name);
            lua_pop(lua, 1);
        }
        hits_.push_back(std::move(hit));
    }
    lua_pop(lua, 1);  // the function
}

// If the last lines are the fourth equal round of a loop, removes the third round.
void LineTrace::fold_loop() {
    std::vector<TracedLines::Line>& lines = seen_.lines;
    const auto is_same = [&](std::size_t a, std::size_t b) {
        return lines[a].line == lines[b].line && lines[a].depth == lines[b].depth && lines[a].file == lines[b].file;
    };
    for (std::size_t turn = 1; turn <= longest_turn && 4 * turn <= lines.size(); ++turn) {
        const std::size_t last = lines.size() - turn, before = last - turn;
        bool repeats = true;
        for (std::size_t i = before - 2 * turn; i < last && repeats; ++i) repeats = is_same(i, i + turn);
        const auto is_running = [&](const Frame& frame) { return frame.line >= before && frame.line < last; };
        if (!repeats || std::any_of(frames_.begin(), frames_.end(), is_running)) continue;
        lines[last].turns_left_out += 1 + lines[before].turns_left_out;
        const auto at = [&](std::size_t index) { return lines.begin() + static_cast<std::ptrdiff_t>(index); };
        lines.erase(at(before), at(last));
        for (Frame& frame : frames_) {
            if (frame.line >= last) frame.line -= turn;
        }
        return;
    }
}

// The values of the file's variables that the function on top of the stack uses, of its local variables, and of fields
// of `tables_`.
std::vector<LineTrace::Value> LineTrace::values_in_sight(lua_State* lua, lua_Debug* event) const {
    std::vector<Value> values;
    for (int i = 1; const char* name = lua_getupvalue(lua, -1, i); ++i) {
        if (*name != '\0' && std::string_view(name) != "_ENV") add_value(values, lua, name);
        lua_pop(lua, 1);
    }
    for (int i = 1; const char* name = lua_getlocal(lua, event, i); ++i) {
        if (!is_hidden(name)) add_value(values, lua, name);
        lua_pop(lua, 1);
    }
    for (const Table& table : tables_) {
        table.push(lua);
        add_fields(values, lua, table.name);
        lua_pop(lua, 1);
    }
    return values;
}

// Called when the line that this function was executing has ended, with everything that the line called. The function
// is on top of the stack.
void LineTrace::end_line(lua_State* lua, lua_Debug* event, int depth, const void* function) {
    std::erase_if(frames_, [&](const Frame& each) { return each.lua == lua && each.depth > depth; });
    const auto frame = std::find_if(frames_.begin(), frames_.end(),
                                    [&](const Frame& each) { return each.lua == lua && each.depth == depth; });
    if (frame == frames_.end()) return;
    if (frame->function == function) {
        // Variables that are no longer visible, such as those of a loop, keep their last value.
        for (Value& value : values_in_sight(lua, event)) put(seen_.lines[frame->line].values, std::move(value));
    }
    frames_.erase(frame);
}

}  // namespace nezumi
