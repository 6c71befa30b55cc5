// The words of the console: what each is called, how it is used, what it does.
#pragma once

#include <lua.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/console/session_parts.hpp"
#include "bindings/lua/values/bridge.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

/// What a word wants done after it.
enum class WordEnd : unsigned char {
    done,
    number,  ///< it returns `Parts::number`
    table,   ///< it returns a function that takes the table to the name that it was given: `robot "mouse" { ... }`
    wait,    ///< `Parts::ticks` are to pass before the input goes on
};

struct Word {
    const char* name;
    const char* usage;  ///< "step(n)": it begins with the name
    const char* help;   ///< one sentence
    int most;           ///< arguments at most
    Expected<WordEnd> (*run)(Session::Parts& parts, const Arguments& arguments);
    /// It runs in the session's own thread, beside the ticks, and asks for what it wants of the system; the others run
    /// between two ticks, and read nothing large from Lua.
    bool beside = false;
};

/// All of them, in the order in which `help()` lists them.
const std::vector<Word>& console_words();

/// Adds the words' functions to the table on top of the stack. May raise a Lua error.
void add_words(lua_State* L, Session::Parts& parts);
/// The word whose function is at `index`; null for any other value.
const Word* word_at(lua_State* L, int index);

/// What `log_level` takes, from the most to the least.
std::vector<std::string> log_level_names();

/// What `robot "mouse"` has returned, which waits for its table: `robot "mouse"`; "" for any other value.
std::string waiting_word_at(lua_State* L, int index);

/// The end of a word that was one act and shows nothing.
template <class Result>
Expected<WordEnd> done(const Expected<Result>& acted) {
    if (!acted) return Unexpected(acted.error());
    return WordEnd::done;
}

/// The name behind "rtm:", where the argument is such a text.
std::optional<std::string> peer_named(const Arguments& arguments, int position);
/// Asks components of other programs, waits for the answer and shows it. For words that run beside the ticks.
Expected<WordEnd> ask_peers(Session::Parts& parts, const PeerWish& wish);

// Each group in its own file.
using WordFunction = Expected<WordEnd>(Session::Parts&, const Arguments&);
WordFunction word_connect, word_disconnect;                                        // wiring
WordFunction word_behavior, word_component, word_robot, word_marker, word_remove;  // members
WordFunction word_activate, word_deactivate, word_log_level;                       // life
WordFunction word_ls, word_find, word_help, word_errors, word_now, word_print;     // looking
WordFunction word_watch, word_unwatch, word_plot, word_drive, word_explain;        // following
WordFunction word_inject, word_hold, word_release;                                 // acting
WordFunction word_teleport, word_stop, word_rearm;
WordFunction word_pause, word_step, word_run, word_speed, word_restart, word_quit;  // time
WordFunction word_reload, word_rollback;                                            // versions
WordFunction word_rtm;                                                              // other programs
WordFunction word_save, word_new, word_picture, word_graph;                         // files

}  // namespace nezumi
