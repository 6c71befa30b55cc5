// One function serves all words: arguments are copied out of Lua, the word is carried out, and only then Lua hears of
// it.
#include "bindings/lua/files/system_lua.hpp"

#include <fmt/format.h>

#include <utility>
#include <variant>

#include "bindings/lua/files/data_file.hpp"
#include "bindings/lua/values/bridge.hpp"

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
    line,
    map,
    marker,
    maze,
    network,
    physics,
    rate,
    robot,
    ros,
    rtm,
    seed,
    wall
};

// What a word gives back to Lua: nothing, a thing of the arena, an entry, or one that waits for its table.
struct Entered {};
struct Begun {
    std::size_t index;
};
using Result = std::variant<std::monostate, FileThing, Entered, Begun>;

Expected<Result> nothing(Expected<void> done) {
    if (!done) return Unexpected(done.error());
    return Result{};
}

// A copy of an argument.
Expected<FileValue> value_of(const Arguments& arguments, int position) {
    if (!arguments.has(position)) return FileValue{};
    return read_file_value(arguments.lua, arguments.index(position));
}

// An end of a connection: a text, or a port itself.
Expected<FileValue> end_of(const WordHost& host, const Arguments& arguments, int position) {
    if (host.port_path && arguments.has(position)) {
        auto path = host.port_path(arguments.lua, arguments.index(position));
        if (!path) return Unexpected(path.error());
        if (*path) return FileValue{std::move(**path)};
    }
    return value_of(arguments, position);
}

// What is given to a word, for messages.
std::string_view usage_of(int word) {
    switch (word) {
        case connect: return "(from, to)";
        case robot:
        case behavior:
        case component: return " \"NAME\" { ... }";
        case csv:
        case map: return " \"FILE\"";
        case rate: return "(hertz)";
        case seed: return "(number)";
        default: return " { ... }";
    }
}

Expected<Result> entry(SystemWords& words, const WordCall& call, const Arguments& arguments) {
    const auto name = value_of(arguments, 1);
    if (!name) return Unexpected(name.error());
    auto begun = words.begin_entry(call, *name);
    if (!begun) return Unexpected(begun.error());
    if (arguments.count() < 2) return Result{Begun{*begun}};
    const auto fields = value_of(arguments, 2);
    if (!fields) return Unexpected(fields.error());
    if (auto done = words.complete_entry(*begun, *fields); !done) return Unexpected(done.error());
    return Result{Entered{}};
}

Expected<Result> wire(const WordHost& host, const WordCall& call, const Arguments& arguments) {
    const auto from = end_of(host, arguments, 1);
    if (!from) return Unexpected(from.error());
    const auto to = end_of(host, arguments, 2);
    if (!to) return Unexpected(to.error());
    return nothing(host.words->connect(call, *from, *to));
}

Expected<Result> carry_out(const WordHost& host, int word, const WordCall& call, const Arguments& arguments) {
    SystemWords& words = *host.words;
    const int most = word == connect || word == robot || word == behavior || word == component ? 2 : 1;
    if (auto ok = arguments.at_most(call.word, most, usage_of(word)); !ok) return Unexpected(ok.error());
    if (word == robot || word == behavior || word == component) return entry(words, call, arguments);
    if (word == connect) return wire(host, call, arguments);
    const auto first = value_of(arguments, 1);
    if (!first) return Unexpected(first.error());
    if (first->is_nil()) return failure(fmt::format("{}: expected an argument, got none", call.word));
    switch (word) {
        case arena: return nothing(words.arena(call, *first));
        case network: return nothing(words.network(call, *first));
        case physics: return nothing(words.physics(call, *first));
        case rate: return nothing(words.rate(call, *first));
        case ros: return nothing(words.ros(call, *first));
        case rtm: return nothing(words.rtm(call, *first));
        case seed: return nothing(words.seed(call, *first));
        default: {
            auto thing = words.thing(call, *first);
            if (!thing) return Unexpected(thing.error());
            return Result{*thing};
        }
    }
}

// Tells the host of an error; what to raise.
Error report(const WordHost& host, const WordCall& call, Error error) {
    if (error.place.file.empty()) {
        error.place = call.place;
        if (!error.message.starts_with(call.word)) error.message = call.word + ": " + error.message;
    }
    error.message = one_line(std::move(error.message));
    return host.fail ? host.fail(std::move(error)) : error;
}

WordCall make_call(lua_State* lua, const WordHost& host, std::string word) {
    WordCall call{std::move(word), calling_place(lua), nullptr};
    if (host.source) call.source = host.source(call.place.file);
    return call;
}

Expected<Result> run_word(lua_State* lua, WordHost& host, int word, bool method) {
    ++host.calls;
    const WordCall call = make_call(lua, host, system_word_names()[static_cast<std::size_t>(word)]);
    host.called = call.place;
    auto done = carry_out(host, word, call, {lua, method ? 2 : 1});
    if (!done) return Unexpected(report(host, call, done.error()));
    return done;
}

Expected<void> complete(lua_State* lua, WordHost& host, std::size_t begun) {
    auto done = Arguments{lua}.at_most("NAME", 1, " { ... }");
    if (done) {
        const auto fields = read_file_value(lua, 1);
        done = fields ? host.words->complete_entry(begun, *fields) : Expected<void>(Unexpected(fields.error()));
    }
    if (done) return {};
    return Unexpected(report(host, make_call(lua, host, ""), done.error()));
}

// The entry that was made last.
int push_entry(lua_State* lua, WordHost& host) {
    if (!host.push_entry) return 0;
    luaL_checkstack(lua, 20, nullptr);
    host.push_entry(lua, name_of(host.words->spec().entries.back()));
    return 1;
}

// What `robot "mouse"` returns: takes the table.
int take_table(lua_State* lua) {
    auto& host = *static_cast<WordHost*>(lua_touserdata(lua, lua_upvalueindex(1)));
    const auto begun = static_cast<std::size_t>(lua_tointeger(lua, lua_upvalueindex(2)));
    bridge(lua, [&] { return complete(lua, host, begun); });
    return push_entry(lua, host);
}

}  // namespace

const std::vector<const char*>& system_word_names() {
    static const std::vector<const char*> names{
        "arena",  "behavior", "box",     "component", "connect", "csv",   "cylinder", "floor", "line", "map",
        "marker", "maze",     "network", "physics",   "rate",    "robot", "ros",      "rtm",   "seed", "wall"};
    return names;
}

int call_system_word(lua_State* lua) {
    auto& host = *static_cast<WordHost*>(lua_touserdata(lua, lua_upvalueindex(1)));
    const auto word = static_cast<int>(lua_tointeger(lua, lua_upvalueindex(2)));
    const bool method = lua_toboolean(lua, lua_upvalueindex(3)) != 0;
    Result result;
    bridge(lua, [&] { return run_word(lua, host, word, method).map([&](const Result& made) { result = made; }); });
    if (const auto* thing = std::get_if<FileThing>(&result)) {
        push_file_thing(lua, *thing);
        return 1;
    }
    if (std::holds_alternative<Entered>(result)) return push_entry(lua, host);
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
