// What a session is made of; its words work on it.
#pragma once

#include <deque>
#include <lua.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/console/drive.hpp"
#include "bindings/console/session.hpp"
#include "bindings/lua/live/objects.hpp"
#include "bindings/lua/sandbox/sliced_call.hpp"
#include "bindings/lua/sandbox/state.hpp"

namespace nezumi {

/// A port whose changes are shown.
struct Watch {
    std::string path;      ///< "name.port"
    std::string shown;     ///< its value as it was shown last
    double shown_at = -1;  ///< [s] simulated; -1: not yet
};

struct Session::Parts {
    Parts(LiveSystem& system, ClockControl& control, SessionOptions settings);

    /// Opens a fresh state with all names in scope.
    Expected<void> open();
    void show(std::string_view text) const {
        if (options.output.show) options.output.show(text);
    }
    void show_error(std::string_view text) const {
        if (options.output.show_error) options.output.show_error(text);
    }

    Expected<ActResult> act(const Act& act) const { return live.act(act, options.who); }

    LiveSystem& live;
    ClockControl& clock;
    SessionOptions options;
    std::deque<std::string> inputs;  ///< handed in and not begun
    std::string input;               ///< that runs
    bool waiting = false;            ///< for the ticks of an `advance` of the clock
    std::vector<Watch> watches;
    Drive drive;
    double number = 0;       ///< what a word returns
    std::int64_t ticks = 0;  ///< that a word waits for
    std::unique_ptr<Objects> objects;
    std::unique_ptr<LuaState> state;
    std::unique_ptr<SlicedCall> call;  ///< of `input`; last: dies first
};

/// Puts the library, the console's words and the system's names into the scope of a state. The names are looked up in
/// the system whenever they are used.
Expected<void> open_scope(Session::Parts& parts);

/// Pushes the table of all that `open_scope` has put there. Needs one place on the stack.
void push_words_table(lua_State* L);

/// Every name that an input can begin with: words, library, components, what was defined at the prompt. Sorted.
std::vector<std::string> names_in_scope(const Session::Parts& parts);

}  // namespace nezumi
