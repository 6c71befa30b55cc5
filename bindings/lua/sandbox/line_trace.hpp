// Records the executed lines of one call and the values of their variables. It takes no time while it is not used, and
// does not change the execution.
#pragma once

#include <cstddef>
#include <lua.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/components/inside.hpp"

namespace nezumi {

class LineTrace {
public:
    /// Limits: recorded lines, events, nested calls, variables of a line, bytes of a value, fields of a table. More is
    /// omitted.
    static constexpr std::size_t most_lines = 300, most_events = 5000;
    static constexpr int deepest = 30;
    static constexpr std::size_t most_values = 48, longest_value = 60;
    static constexpr int most_fields = 12;
    /// Loops with rounds of at most this many lines are shortened to the first two rounds and the last one.
    static constexpr std::size_t longest_turn = 40;

    using Value = TracedLines::Value;

    /// A table that scripts know by this name. `push` pushes it, raises no error and takes no memory.
    struct Table {
        const char* name;
        void (*push)(lua_State* lua);
    };

    /// A line whose executions are noted with the values of their variables.
    struct Watched {
        std::string file;  ///< its name in messages, or the end of it after a '/'
        int line = 0;
    };
    /// The moment before a watched line is executed: the local variables of the function, and variables of the file
    /// that it uses.
    struct Hit {
        std::string file;  ///< as in messages
        int line = 0;
        std::vector<ErrorFrames::Variable> variables{};
    };
    static constexpr std::size_t most_hits = 1000;

    /// Records what this thread executes during its lifetime. The fields of the tables count as variables.
    explicit LineTrace(std::vector<Table> tables = {}, std::vector<Watched> watched = {});
    ~LineTrace();
    LineTrace(const LineTrace&) = delete;
    LineTrace& operator=(const LineTrace&) = delete;

    /// Called for a coroutine that is about to run: if this thread records lines, also records those of the coroutine.
    static void follow(lua_State* coroutine);

    /// The lines without their texts. Values are those of the visible variables after a line, and of variables that
    /// ended with it.
    TracedLines take() { return std::move(seen_); }
    /// The executions of watched lines, at most `most_hits`.
    std::vector<Hit> take_hits() { return std::move(hits_); }

private:
    // A function on the call stack, with its present line.
    struct Frame {
        lua_State* lua;
        int depth;
        const void* function;
        std::size_t line;  // index into seen_.lines
    };

    static void on_event(lua_State* lua, lua_Debug* event);
    void note(lua_State* lua, lua_Debug* event);
    void note_hit(lua_State* lua, lua_Debug* event);
    bool is_over() const { return seen_.is_cut && watched_.empty(); }
    std::vector<Value> values_in_sight(lua_State* lua, lua_Debug* event) const;
    void end_line(lua_State* lua, lua_Debug* event, int depth, const void* function);
    void fold_loop();

    LineTrace* outer_;
    std::vector<Table> tables_;
    std::vector<Watched> watched_;
    std::vector<Hit> hits_;
    TracedLines seen_;
    std::size_t events_ = 0;
    std::vector<Frame> frames_;
};

/// Whether the source of a chunk, as Lua names it ("@behaviors/keeper.lua"), is the file `name` ("keeper.lua").
bool is_file(std::string_view source, std::string_view name);

/// The value on top of the stack as it is shown in a trace; "" for values without a text, such as functions. Raises no
/// error and takes no memory of the state.
std::string traced_text(lua_State* lua);

}  // namespace nezumi
