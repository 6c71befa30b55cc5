// Tries each table in one line, and uses several lines if it is too long.
#include "bindings/lua/sandbox/inspect.hpp"

#include <algorithm>
#include <map>
#include <string_view>
#include <vector>

#include "bindings/lua/sandbox/call.hpp"
#include "bindings/lua/sandbox/locked_table.hpp"
#include "bindings/lua/sandbox/ordered.hpp"
#include "bindings/lua/sandbox/text.hpp"
#include "bindings/lua/sandbox/watchdog.hpp"
#include "engine/base/lua_text.hpp"
#include "engine/base/names.hpp"

namespace nezumi {
namespace {

constexpr int most_free_visits = 4;  // of a table whose entries have been counted, before they count again

// The methods run within a protected call and may raise Lua errors. So their objects with destructors are members of
// this class, which exists outside of that call.
class Inspector {
public:
    Inspector(const InspectOptions& options, InspectWork& work) : options_(options), work_(work) {}

    // Shows the value at index 1 of the coroutine in which it is called.
    void look(lua_State* lua, bool quote) {
        lua_ = lua;
        value(1, 0, 0, quote);
    }
    std::string take() { return std::move(out_); }
    const std::string& shown() const { return out_; }

private:
    void value(int index, int depth, std::size_t indent, bool quote);
    void text(int index, bool quote);
    void table(int index, int depth, std::size_t indent);
    bool entries(int index, int depth, std::size_t indent, bool flat);
    void all_entries(int index, int depth, std::size_t indent, bool flat, std::size_t& count);
    void first_elements(int index, int depth, std::size_t indent, bool flat, std::size_t& count);
    bool begin_entry(std::size_t indent, bool flat, std::size_t& count, bool is_known = true);
    bool can_count(int index);
    bool is_too_long() const { return limit_ != 0 && out_.size() > limit_; }
    void key(bool& in_sequence, lua_Integer& next);
    bool is_open(const void* table) const;

    lua_State* lua_ = nullptr;
    const InspectOptions& options_;
    InspectWork& work_;
    std::string out_;
    std::string scratch_;
    std::map<const void*, int> counted_;  // visits of each counted table: it is tried in one line, then in several
    std::vector<const void*> open_;       // the outer tables of the one that is shown
    std::size_t limit_ = 0;               // limit of `out_` while a table is tried in one line; 0: none
};

void quote_into(std::string& out, std::string_view text) noexcept { out += lua_quoted(text); }

bool has_metafield(lua_State* L, int index, const char* name) {
    if (luaL_getmetafield(L, index, name) == LUA_TNIL) return false;
    lua_pop(L, 1);
    return true;
}

// Whether the value is shown by its entries: a table, or an object such as `config` without its own text.
bool has_entries(lua_State* L, int index) {
    const int type = lua_type(L, index);
    if (type != LUA_TTABLE && !(type == LUA_TUSERDATA && has_metafield(L, index, "__pairs"))) return false;
    return !has_metafield(L, index, "__tostring");
}

void Inspector::text(int index, bool quote) {
    std::size_t length = 0;
    const char* data = lua_tolstring(lua_, index, &length);
    const bool cut = length > options_.text;
    const std::string_view given(data, cut ? options_.text : length);
    if (quote) {
        quote_into(out_, given);
    } else {
        out_ += given;
    }
    if (cut) out_ += "...";
}

bool Inspector::is_open(const void* table) const {
    for (const void* each : open_) {
        if (each == table) return true;
    }
    return false;
}

void Inspector::value(int index, int depth, std::size_t indent, bool quote) {
    luaL_checkstack(lua_, 12, nullptr);
    index = lua_absindex(lua_, index);
    const int type = lua_type(lua_, index);
    if (type == LUA_TSTRING) return text(index, quote);
    if (has_entries(lua_, index)) return table(index, depth, indent);
    std::size_t length = 0;
    const char* shown = push_text(lua_, index, &length);
    // The text of an object may have several lines; within a table only the first is shown.
    std::string_view given(shown, length);
    if (depth > 0) given = given.substr(0, given.find('\n'));
    out_ += given;
    lua_pop(lua_, 1);
}

// Writes the part before the value of a pair. Stack: key, value.
void Inspector::key(bool& in_sequence, lua_Integer& next) {
    if (in_sequence && lua_isinteger(lua_, -2) != 0 && lua_tointeger(lua_, -2) == next) {
        ++next;
        return;
    }
    in_sequence = false;
    if (lua_type(lua_, -2) == LUA_TSTRING) {
        std::size_t length = 0;
        const char* data = lua_tolstring(lua_, -2, &length);
        if (is_identifier({data, length})) {
            out_.append(data, length);
        } else {
            out_ += '[';
            text(-2, true);
            out_ += ']';
        }
    } else {
        out_ += '[';
        std::size_t length = 0;
        const char* data = push_text(lua_, -2, &length);
        out_.append(data, length);
        lua_pop(lua_, 1);
        out_ += ']';
    }
    out_ += " = ";
}

// Whether a table has few enough entries to sort them; takes a step for each entry that it visits.
bool Inspector::can_count(int index) {
    if (luaL_getmetafield(lua_, index, "__pairs") != LUA_TNIL) return lua_pop(lua_, 1), true;
    const void* const self = lua_topointer(lua_, index);
    const auto counted = counted_.find(self);
    if (counted != counted_.end() && ++counted->second <= most_free_visits) return true;
    const int top = lua_gettop(lua_);
    const int table = push_behind_lock(lua_, index) ? lua_gettop(lua_) : index;
    std::size_t entries = 0;
    for (lua_pushnil(lua_); entries <= work_.steps && lua_next(lua_, table) != 0; lua_pop(lua_, 1)) ++entries;
    lua_settop(lua_, top);
    const bool few = entries <= work_.steps;
    // A table that is too large takes half of the remaining steps, so that some steps remain for other tables.
    work_.steps -= few ? entries : (work_.steps + 1) / 2;
    if (few) counted_.emplace(self, 0);
    return few;
}

// Begins an entry. If there is no room for it, or if not `is_known`, writes "..." and returns false.
bool Inspector::begin_entry(std::size_t indent, bool flat, std::size_t& count, bool is_known) {
    const bool fits = ++count <= options_.items && out_.size() < work_.bytes && is_known;
    if (!flat) {
        out_.append(count > 1 ? ",\n" : "\n").append(indent + 2, ' ');
    } else {
        out_ += count > 1 ? ", " : " ";
    }
    if (!fits) out_ += "...";
    return fits;
}

void Inspector::all_entries(int index, int depth, std::size_t indent, bool flat, std::size_t& count) {
    const int top = lua_gettop(lua_);
    lua_pushcfunction(lua_, ordered_pairs);
    lua_pushvalue(lua_, index);
    lua_call(lua_, 1, 3);  // iterator, table, first key
    bool in_sequence = true;
    lua_Integer next = 1;
    for (;;) {
        lua_pushvalue(lua_, top + 1);
        lua_pushvalue(lua_, top + 2);
        lua_pushvalue(lua_, top + 3);
        lua_call(lua_, 2, 2);
        if (lua_isnil(lua_, -2) || !begin_entry(indent, flat, count)) break;
        key(in_sequence, next);
        value(-1, depth + 1, indent + 2, true);
        if (is_too_long()) break;
        lua_copy(lua_, -2, top + 3);
        lua_pop(lua_, 2);
    }
    lua_settop(lua_, top);
}

void Inspector::first_elements(int index, int depth, std::size_t indent, bool flat, std::size_t& count) {
    const int top = lua_gettop(lua_);
    const int table = push_behind_lock(lua_, index) ? lua_gettop(lua_) : index;
    while (!is_too_long()) {
        const bool is_element = lua_rawgeti(lua_, table, static_cast<lua_Integer>(count + 1)) != LUA_TNIL;
        if (!begin_entry(indent, flat, count, is_element)) break;
        value(-1, depth + 1, indent + 2, true);
        lua_pop(lua_, 1);
    }
    lua_settop(lua_, top);
}

// Writes the entries of a table. Returns false as soon as they do not fit in one line, while this is tried.
bool Inspector::entries(int index, int depth, std::size_t indent, bool flat) {
    std::size_t count = 0;
    out_ += '{';
    if (can_count(index)) {
        all_entries(index, depth, indent, flat, count);
    } else {
        first_elements(index, depth, indent, flat, count);
    }
    if (is_too_long()) return false;
    if (count > 0) {
        if (flat) {
            out_ += ' ';
        } else {
            out_.append("\n").append(indent, ' ');
        }
    }
    out_ += '}';
    return !is_too_long();
}

void Inspector::table(int index, int depth, std::size_t indent) {
    const void* self = lua_topointer(lua_, index);
    if (is_open(self)) {
        out_ += "<cycle>";
        return;
    }
    if (depth >= options_.depth || work_.steps == 0 || out_.size() >= work_.bytes) {
        out_ += "{...}";
        return;
    }
    open_.push_back(self);
    const std::size_t begin = out_.size();
    if (limit_ != 0) {
        entries(index, depth, indent, true);
    } else {
        // The start of the present line: the text before the table counts for the width as well.
        const std::size_t line = out_.rfind('\n') == std::string::npos ? 0 : out_.rfind('\n') + 1;
        limit_ = line + options_.width;
        const bool fits = entries(index, depth, indent, true);
        limit_ = 0;
        if (!fits) {
            out_.resize(begin);
            entries(index, depth, indent, false);
        }
    }
    open_.pop_back();
}

// Arguments: a table, its inspector. Returns its text.
int show_table(lua_State* L) {
    auto& inspector = *static_cast<Inspector*>(lua_touserdata(L, 2));
    inspector.look(L, false);
    lua_pushlstring(L, inspector.shown().data(), inspector.shown().size());
    return 1;
}

// Pushes the text of the table at `index`. An error of its metamethods replaces the text, because printing a table must
// not stop a behaviour. The error of the time limit is raised again.
void push_table_text(lua_State* L, int index, InspectWork& work) {
    int status = LUA_OK;
    {
        const InspectOptions options{.quote = false};
        Inspector inspector(options, work);
        lua_pushcfunction(L, show_table);
        lua_pushvalue(L, index);
        lua_pushlightuserdata(L, &inspector);
        status = lua_pcall(L, 2, 1, 0);
        work.bytes -= std::min(work.bytes, inspector.shown().size());
    }  // from here on an error skips no destructor
    if (status == LUA_OK) return;
    poll_budget(L);
    if (status == LUA_ERRMEM) lua_error(L);
    push_text(L, -1);
    lua_pushfstring(L, "<can't be shown: %s>", lua_tostring(L, -1));
    lua_replace(L, -3);
    lua_pop(L, 1);
}

}  // namespace

std::string inspect(lua_State* L, int index, const InspectOptions& options) {
    if (lua_checkstack(L, 20) == 0) return "<no room on the stack to show it>";
    const int top = lua_gettop(L);
    index = lua_absindex(L, index);
    InspectWork own;
    InspectWork& work = options.work != nullptr ? *options.work : own;
    Inspector inspector(options, work);
    lua_pushvalue(L, index);
    lua_pushcfunction(L, [](lua_State* inside) -> int {
        static_cast<Inspector*>(lua_touserdata(inside, 2))->look(inside, lua_toboolean(inside, 3) != 0);
        return 0;
    });
    lua_insert(L, -2);
    lua_pushlightuserdata(L, &inspector);
    lua_pushboolean(L, options.quote ? 1 : 0);
    const CallResult shown = protected_call(L, 3, 0, Budget{0.01});
    lua_settop(L, top);
    if (shown) {
        std::string text = inspector.take();
        work.bytes -= std::min(work.bytes, text.size());
        return text;
    }
    return "<can't be shown: " + describe(shown.error()) + ">";
}

void push_line(lua_State* L) {
    const int count = lua_gettop(L);
    luaL_checkstack(L, LUA_MINSTACK, nullptr);
    InspectWork work;
    luaL_Buffer line;
    luaL_buffinit(L, &line);
    for (int i = 1; i <= count; ++i) {
        if (i > 1) luaL_addchar(&line, '\t');
        if (has_entries(L, i)) {
            push_table_text(L, i, work);
        } else {
            push_text(L, i);
        }
        luaL_addvalue(&line);
    }
    luaL_pushresult(&line);
}

}  // namespace nezumi
