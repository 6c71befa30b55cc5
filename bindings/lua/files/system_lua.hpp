// The words of systems as Lua functions: globals of a system file, or methods of a scenario's object.
#pragma once

#include <functional>
#include <lua.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/files/system_words.hpp"
#include "bindings/lua/values/bridge.hpp"

namespace nezumi {

struct WordHost;

/// A word of system files, without the fields of its table.
struct SystemWord {
    enum class Form {
        plain,  ///< returns nothing
        thing,  ///< returns an object of the arena
        entry,  ///< has a name; its table may follow in a second call
    };
    struct Result;
    /// Documentation of a word without a described table, for editors.
    struct Help {
        struct Parameter {
            std::string name, type;
        };
        std::string doc{};
        std::vector<Parameter> parameters{};
    };

    std::string_view name;  ///< of static duration
    Form form;
    int most;           ///< maximum number of arguments
    std::string usage;  ///< what is given to it, for messages: " { ... }"
    Expected<Result> (*run)(WordHost& host, const WordCall& call, const Arguments& arguments);
    Help help{};
};

/// "arena", "behavior", "box", ..., sorted: the words of every system, and those of these peers.
std::vector<SystemWord> system_words(const PeerWords& peers = {});
/// The names of these words, in the same order.
std::vector<std::string_view> system_word_names(const PeerWords& peers = {});

/// The data that the functions of the words use. Must outlive their Lua state.
struct WordHost {
    SystemWords* words = nullptr;
    /// All words, by their numbers. Those that describe peers must be among the `PeerWords` of `words`.
    std::vector<SystemWord> all = system_words();
    /// The text of a file, for locations within a call; may be empty, and may return null.
    std::function<const FieldSource*(const std::string& shown)> source{};
    /// Gets the error of a word, and returns the error to raise in Lua. Empty: raises the error itself.
    std::function<Error(Error error)> fail{};
    /// Pushes the result of words such as `robot "mouse" { ... }`, whose `name` is "mouse". May raise a Lua error. If
    /// this is empty, such words return nothing.
    std::function<void(lua_State* lua, std::string_view name)> push_entry{};
    /// "name.port" of an argument that is a port object; nothing for other values. An error if words can't use this
    /// port. Raises no Lua error. Empty: there are no port objects.
    std::function<Expected<std::optional<std::string>>(lua_State* lua, int index)> port_path{};
    /// The location of the last call.
    Place called{};
    /// The number of calls.
    std::size_t calls = 0;
};

/// The function of every word. Upvalue 1: a light userdata, the `WordHost`; upvalue 2: the number of the word; upvalue
/// 3: true for a method, whose first argument is the object.
int call_system_word(lua_State* lua);

/// Adds all words to the table on top of the stack, as functions or as methods (`s:robot "mouse" { ... }`). May raise a
/// Lua error.
void add_system_words(lua_State* lua, WordHost& host, bool methods);

}  // namespace nezumi
