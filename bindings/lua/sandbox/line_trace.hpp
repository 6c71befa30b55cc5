// The lines of Lua that run in one call, and what their variables hold behind each: a look that costs nothing while
// nobody looks, and changes nothing of what is looked at.
#pragma once

#include <cstddef>
#include <lua.hpp>
#include <string>
#include <utility>
#include <vector>

#include "engine/components/inside.hpp"

namespace nezumi {

class LineTrace {
public:
    /// Lines that are noted, looks at what Lua does, calls within calls, variables of a line, bytes of a value: what is
    /// more is left out.
    static constexpr std::size_t most_lines = 300, most_events = 5000;
    static constexpr int deepest = 30;
    static constexpr std::size_t most_values = 48, longest_value = 60;
    static constexpr int most_fields = 12;
    /// Of a loop's turns of at most so many lines the first two and the last are kept.
    static constexpr std::size_t longest_turn = 40;

    using Value = TracedLines::Value;

    /// A table that scripts have by this name; `push` pushes it, raises nothing and takes no memory.
    struct Table {
        const char* name;
        void (*push)(lua_State* lua);
    };

    /// While it lives, what this thread runs is noted; of the tables the fields count as variables.
    explicit LineTrace(std::vector<Table> tables = {});
    ~LineTrace();
    LineTrace(const LineTrace&) = delete;
    LineTrace& operator=(const LineTrace&) = delete;

    /// A coroutine that is about to run: if this thread notes lines, those of that one.
    static void follow(lua_State* coroutine);

    /// Without their texts. The values are of the variables in sight once a line had run, and of those that ended
    /// with it.
    TracedLines take() { return std::move(seen_); }

private:
    // A function that is being called, and its line that runs.
    struct Frame {
        lua_State* lua;
        int depth;
        const void* function;
        std::size_t line;  // of seen_.lines
    };

    static void on_event(lua_State* lua, lua_Debug* event);
    void note(lua_State* lua, lua_Debug* event);
    std::vector<Value> values_in_sight(lua_State* lua, lua_Debug* event) const;
    void end_line(lua_State* lua, lua_Debug* event, int depth, const void* function);
    void fold_loop();

    LineTrace* outer_;
    std::vector<Table> tables_;
    TracedLines seen_;
    std::size_t events_ = 0;
    std::vector<Frame> frames_;
};

}  // namespace nezumi
