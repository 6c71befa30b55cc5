// The system's words as Lua functions: globals of a system file, methods of a scenario's object.
#pragma once

#include <functional>
#include <lua.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/files/system_words.hpp"
#include "bindings/lua/values/bridge.hpp"

namespace nezumi {

/// What the words' functions work on. Must outlive the Lua state that has them.
struct WordHost {
    SystemWords* words = nullptr;
    /// The text of a file, for places within a call; may be empty, and may return null.
    std::function<const FileSource*(const std::string& shown)> source{};
    /// Is given the error of a word, and returns what is raised in Lua. Empty: the error itself.
    std::function<Error(Error error)> fail{};
    /// Pushes what `robot "mouse" { ... }` and its like return, by the name. May raise a Lua error. Empty: they return
    /// nothing.
    std::function<void(lua_State* lua, std::string_view name)> push_entry{};
    /// "name.port" of the object that an argument is; nothing when it is no port. An error when words can't have this
    /// port. Raises no Lua error. Empty: there are no such objects.
    std::function<Expected<std::optional<std::string>>(lua_State* lua, int index)> port_path{};
    /// Where a word was called last.
    Place called{};
    /// How many words were called.
    std::size_t calls = 0;
};

/// A word of system files: all that is said of it, but for the fields of its table.
struct SystemWord {
    enum class Form {
        plain,  ///< gives nothing back
        thing,  ///< a thing of the arena
        entry,  ///< has a name, and its table may follow in a call of its own
    };
    struct Result;
    /// Of a word without a described table: what editors show.
    struct Help {
        struct Parameter {
            std::string_view name, type;
        };
        std::string_view doc{};
        Parameter parameters[3] = {};  ///< an empty name: no more
    };

    const char* name;
    Form form;
    int most;                ///< arguments at most
    std::string_view usage;  ///< what is given to it, for messages: " { ... }"
    Expected<Result> (*run)(WordHost& host, const WordCall& call, const Arguments& arguments);
    Help help{};
};

/// "arena", "behavior", "box", ..., in the order of their numbers.
std::span<const SystemWord> system_words();
/// What they are called, in the same order.
const std::vector<const char*>& system_word_names();

/// The function of every word. Upvalue 1: a light userdata, the `WordHost`; upvalue 2: the word's number; upvalue 3:
/// true when it is a method, so that its first argument is the object.
int call_system_word(lua_State* lua);

/// Adds all words to the table on top of the stack, as functions or as methods (`s:robot "mouse" { ... }`). May raise a
/// Lua error.
void add_system_words(lua_State* lua, WordHost& host, bool methods);

}  // namespace nezumi
