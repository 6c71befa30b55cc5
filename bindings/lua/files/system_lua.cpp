// One function serves all words: arguments are copied out of Lua, the word is carried out, and only then Lua hears of
// it.
#include "bindings/lua/files/system_lua.hpp"

#include <fmt/format.h>

#include <utility>
#include <variant>

#include "bindings/lua/files/data_file.hpp"

namespace nezumi {
namespace {

enum Word : int {
    arena,
    behavior,
    box,
    component,
    connect,
    csv,
    cylinder,
    floor,
    marker,
    physics,
    rate,
    robot,
    seed,
    wall
};

// What a word gives back to Lua: nothing, a thing of the arena, or an entry that waits for its table.
struct Begun {
    std::size_t index;
};
using Result = std::variant<std::monostate, FileThing, Begun>;

Expected<Result> nothing(Expected<void> done) {
    if (!done) return Unexpected(done.error());
    return Result{};
}

// The arguments of a word, copied.
struct Arguments {
    lua_State* lua;
    int first;  // after the object of a method

    int count() const { return lua_gettop(lua) - first + 1; }
    Expected<FileValue> at(int index) const {
        if (first + index > lua_gettop(lua)) return FileValue{};
        return read_file_value(lua, first + index);
    }
};

Expected<Result> entry(SystemWords& words, const WordCall& call, const Arguments& arguments) {
    const auto name = arguments.at(0);
    if (!name) return Unexpected(name.error());
    auto begun = words.begin_entry(call, *name);
    if (!begun) return Unexpected(begun.error());
    if (arguments.count() < 2) return Result{Begun{*begun}};
    const auto fields = arguments.at(1);
    if (!fields) return Unexpected(fields.error());
    return nothing(words.complete_entry(*begun, *fields));
}

Expected<Result> carry_out(SystemWords& words, int word, const WordCall& call, const Arguments& arguments) {
    const int most = word == connect || word == robot || word == behavior || word == component ? 2 : 1;
    if (arguments.count() > most) {
        return failure(fmt::format("{}: expected at most {} argument{}, got {}", call.word, most, most > 1 ? "s" : "",
                                   arguments.count()));
    }
    if (word == robot || word == behavior || word == component) return entry(words, call, arguments);
    const auto first = arguments.at(0);
    if (!first) return Unexpected(first.error());
    const auto second = arguments.at(1);
    if (!second) return Unexpected(second.error());
    if (first->is_nil() && word != connect)
        return failure(fmt::format("{}: expected an argument, got none", call.word));
    switch (word) {
        case arena: return nothing(words.arena(call, *first));
        case connect: return nothing(words.connect(call, *first, *second));
        case physics: return nothing(words.physics(call, *first));
        case rate: return nothing(words.rate(call, *first));
        case seed: return nothing(words.seed(call, *first));
        default: {
            auto thing = words.thing(call, *first);
            if (!thing) return Unexpected(thing.error());
            return Result{*thing};
        }
    }
}

// Tells the host of an error; nullptr when there is none, else the text to raise.
const char* report(WordHost& host, const WordCall& call, Error error) {
    if (error.place.file.empty()) {
        error.place = call.place;
        if (!error.message.starts_with(call.word)) error.message = call.word + ": " + error.message;
    }
    error.message = one_line(std::move(error.message));
    if (host.fail) return host.fail(std::move(error));
    host.raised = describe(error);
    return host.raised.c_str();
}

WordCall make_call(lua_State* lua, const WordHost& host, std::string word) {
    WordCall call{std::move(word), calling_place(lua), nullptr};
    if (host.source) call.source = host.source(call.place.file);
    return call;
}

// Raises no Lua error. What to raise, or null.
const char* run_word(lua_State* lua, WordHost& host, int word, bool method, Result& result) {
    ++host.calls;
    const WordCall call = make_call(lua, host, system_word_names()[static_cast<std::size_t>(word)]);
    auto done = carry_out(*host.words, word, call, {lua, method ? 2 : 1});
    if (!done) return report(host, call, done.error());
    result = *done;
    return nullptr;
}

const char* complete(lua_State* lua, WordHost& host, std::size_t begun) {
    auto fields = read_file_value(lua, 1);
    auto done = fields ? host.words->complete_entry(begun, *fields) : Expected<void>(Unexpected(fields.error()));
    if (done) return nullptr;
    return report(host, make_call(lua, host, ""), done.error());
}

// What `robot "mouse"` returns: takes the table.
int take_table(lua_State* lua) {
    auto& host = *static_cast<WordHost*>(lua_touserdata(lua, lua_upvalueindex(1)));
    const auto begun = static_cast<std::size_t>(lua_tointeger(lua, lua_upvalueindex(2)));
    if (const char* problem = complete(lua, host, begun); problem != nullptr) {
        lua_pushstring(lua, problem);
        return lua_error(lua);
    }
    return 0;
}

}  // namespace

const std::vector<const char*>& system_word_names() {
    static const std::vector<const char*> names{"arena", "behavior", "box",   "component", "connect",
                                                "csv",   "cylinder", "floor", "marker",    "physics",
                                                "rate",  "robot",    "seed",  "wall"};
    return names;
}

int call_system_word(lua_State* lua) {
    auto& host = *static_cast<WordHost*>(lua_touserdata(lua, lua_upvalueindex(1)));
    const auto word = static_cast<int>(lua_tointeger(lua, lua_upvalueindex(2)));
    const bool method = lua_toboolean(lua, lua_upvalueindex(3)) != 0;
    Result result;
    if (const char* problem = run_word(lua, host, word, method, result); problem != nullptr) {
        lua_pushstring(lua, problem);
        return lua_error(lua);
    }
    if (const auto* thing = std::get_if<FileThing>(&result)) {
        push_file_thing(lua, *thing);
        return 1;
    }
    if (const auto* begun = std::get_if<Begun>(&result)) {
        lua_pushvalue(lua, lua_upvalueindex(1));
        lua_pushinteger(lua, static_cast<lua_Integer>(begun->index));
        lua_pushcclosure(lua, take_table, 2);
        return 1;
    }
    return 0;
}

void add_system_words(lua_State* lua, WordHost& host, bool methods) {
    lua_Integer number = 0;
    for (const char* name : system_word_names()) {
        lua_pushlightuserdata(lua, &host);
        lua_pushinteger(lua, number++);
        lua_pushboolean(lua, methods ? 1 : 0);
        lua_pushcclosure(lua, call_system_word, 3);
        lua_setfield(lua, -2, name);
    }
}

}  // namespace nezumi
