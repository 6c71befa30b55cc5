// One function serves all words: it copies the arguments out of Lua, executes the word, and only then raises an error
// or pushes the result.
#include "bindings/lua/files/system_lua.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "bindings/lua/files/data_file.hpp"
#include "bindings/lua/files/file_value.hpp"
#include "bindings/lua/values/codec.hpp"
#include "engine/system/peer_word.hpp"

namespace nezumi {
namespace {

// Results: an entry that was added, and one that waits for its table.
struct AddedEntry {};
struct PendingEntry {
    std::size_t index;
};

}  // namespace

/// The result of a word: nothing, an object of the arena, an entry, or an entry that waits for its table.
struct SystemWord::Result {
    std::variant<std::monostate, FileThing, AddedEntry, PendingEntry, Value> made;
};

namespace {

using Result = SystemWord::Result;

Expected<Result> nothing(Expected<void> done) {
    if (!done) return Unexpected(done.error());
    return Result{};
}

// A copy of an argument.
Expected<Value> value_of(const Arguments& arguments, int position) {
    if (!arguments.has(position)) return Value{};
    return read_file_value(arguments.lua, arguments.index(position));
}

// One end of a connection: a text, or a port object.
Expected<Value> end_of(const WordHost& host, const Arguments& arguments, int position) {
    if (host.port_path && arguments.has(position)) {
        auto path = host.port_path(arguments.lua, arguments.index(position));
        if (!path) return Unexpected(path.error());
        if (*path) return Value{std::move(**path)};
    }
    return value_of(arguments, position);
}

Expected<Result> entry(WordHost& host, const WordCall& call, const Arguments& arguments) {
    const auto name = value_of(arguments, 1);
    if (!name) return Unexpected(name.error());
    auto pending = host.words->begin_entry(call, *name);
    if (!pending) return Unexpected(pending.error());
    if (arguments.count() < 2) return Result{PendingEntry{*pending}};
    const auto fields = value_of(arguments, 2);
    if (!fields) return Unexpected(fields.error());
    if (auto done = host.words->complete_entry(*pending, *fields); !done) return Unexpected(done.error());
    return Result{AddedEntry{}};
}

Expected<Result> wire(WordHost& host, const WordCall& call, const Arguments& arguments) {
    const auto from = end_of(host, arguments, 1);
    if (!from) return Unexpected(from.error());
    const auto to = end_of(host, arguments, 2);
    if (!to) return Unexpected(to.error());
    return nothing(host.words->connect(call, *from, *to));
}

// The argument of a word that takes exactly one.
Expected<Value> only_argument(const WordCall& call, const Arguments& arguments) {
    auto value = value_of(arguments, 1);
    if (value && value->is_nothing()) return failure(fmt::format("{}: expected an argument, got none", call.word));
    return value;
}

Expected<Result> thing(WordHost& host, const WordCall& call, const Arguments& arguments) {
    const auto value = only_argument(call, arguments);
    if (!value) return Unexpected(value.error());
    return host.words->thing(call, *value).map([](const FileThing& made) { return Result{made}; });
}

Expected<Result> argument(WordHost& host, const WordCall& call, const Arguments& arguments) {
    const auto name = value_of(arguments, 1), otherwise = value_of(arguments, 2), options = value_of(arguments, 3);
    for (const auto* value : {&name, &otherwise, &options}) {
        if (!*value) return Unexpected(value->error());
    }
    auto made = host.words->argument(call, *name, *otherwise, *options);
    if (!made) return Unexpected(made.error());
    return Result{std::move(*made)};
}

template <Expected<void> (SystemWords::*setting)(const WordCall&, const Value&)>
Expected<Result> set(WordHost& host, const WordCall& call, const Arguments& arguments) {
    const auto value = only_argument(call, arguments);
    if (!value) return Unexpected(value.error());
    return nothing((host.words->*setting)(call, *value));
}

// Reports an error to the host; returns the error to raise.
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

Expected<Result> run_word(lua_State* lua, WordHost& host, const SystemWord& word, bool method) {
    ++host.calls;
    const WordCall call = make_call(lua, host, std::string(word.name));
    host.called = call.place;
    const Arguments arguments{lua, method ? 2 : 1};
    const auto fits = arguments.at_most(word.name, word.most, word.usage);
    auto done = fits ? word.run(host, call, arguments) : Unexpected(fits.error());
    if (!done) return Unexpected(report(host, call, done.error()));
    return done;
}

Expected<void> complete(lua_State* lua, WordHost& host, std::size_t pending) {
    auto done = Arguments{lua}.at_most(host.words->pending_title(pending), 1, " { ... }");
    if (done) {
        const auto fields = read_file_value(lua, 1);
        done = fields ? host.words->complete_entry(pending, *fields) : Expected<void>(Unexpected(fields.error()));
    }
    if (done) return {};
    return Unexpected(report(host, make_call(lua, host, ""), done.error()));
}

// Pushes the entry that was added last.
int push_entry(lua_State* lua, WordHost& host) {
    if (!host.push_entry) return 0;
    luaL_checkstack(lua, 20, nullptr);
    host.push_entry(lua, name_of(host.words->spec().entries.back()));
    return 1;
}

// The function that `robot "mouse"` returns: it takes the table.
int take_table(lua_State* lua) {
    auto& host = *static_cast<WordHost*>(lua_touserdata(lua, lua_upvalueindex(1)));
    const auto pending = static_cast<std::size_t>(lua_tointeger(lua, lua_upvalueindex(2)));
    bridge(lua, [&] { return complete(lua, host, pending); });
    return push_entry(lua, host);
}

}  // namespace

std::vector<SystemWord> system_words(const PeerWords& peers) {
    using Words = SystemWords;
    using Form = SystemWord::Form;
    constexpr const char *table = " { ... }", *named = " \"NAME\" { ... }", *of_file = " \"FILE\"";
    std::vector<std::string> ends{"\"name.port\""};
    for (const PeerWord* peer : peers) {
        if (!peer->port_form().empty()) ends.push_back(fmt::format("\"{}\"", peer->port_form()));
    }
    std::vector<SystemWord> words{
        {"arena", Form::plain, 1, table, set<&Words::arena>},
        {"argument",
         Form::plain,
         3,
         "(name, default, { min =, max =, doc = })",
         argument,
         {"A value with a default, which `--set name=value` overrides.",
          {{"name", "string"}, {"default", "any"}, {"options", "table?"}}}},
        {"behavior", Form::entry, 2, named, entry},
        {"box", Form::thing, 1, table, thing},
        {"component", Form::entry, 2, named, entry},
        {"connect",
         Form::plain,
         2,
         "(from, to)",
         wire,
         {"Connects an out-port to an in-port of the same type.",
          {{"from", fmt::format("string|Port {}, or in a scenario the port itself", fmt::join(ends, ", "))},
           {"to", "string|Port"}}}},
        {"csv",
         Form::thing,
         1,
         of_file,
         thing,
         {"Fixed boxes from a file with rows x,y,z,lx,ly,lz,yaw.", {{"file", "string"}}}},
        {"cylinder", Form::thing, 1, table, thing},
        {"floor", Form::thing, 1, table, thing},
        {"line", Form::thing, 1, table, thing},
        {"map",
         Form::thing,
         1,
         of_file,
         thing,
         {"Fixed boxes from a map of ROS: the occupied pixels of the picture that the YAML file names.",
          {{"file", "string"}}}},
        {"marker", Form::thing, 1, table, thing},
        {"maze", Form::thing, 1, " \"FILE\" or { ... }", thing, {"", {{"fields", "string|MazeFields"}}}},
        {"physics", Form::plain, 1, table, set<&Words::physics>},
        {"rate", Form::plain, 1, "(hertz)", set<&Words::rate>, {"Ticks per second; default 100.", {{"hz", "number"}}}},
        {"robot", Form::entry, 2, named, entry},
        {"seed",
         Form::plain,
         1,
         "(number)",
         set<&Words::seed>,
         {"The seed of everything random in the run.", {{"n", "integer"}}}},
        {"wall", Form::thing, 1, table, thing},
    };
    for (const PeerWord* peer : peers) words.push_back({peer->name(), Form::plain, 1, table, set<&Words::peer>});
    std::sort(words.begin(), words.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    return words;
}

std::vector<std::string_view> system_word_names(const PeerWords& peers) {
    std::vector<std::string_view> names;
    for (const SystemWord& word : system_words(peers)) names.push_back(word.name);
    return names;
}

int call_system_word(lua_State* lua) {
    auto& host = *static_cast<WordHost*>(lua_touserdata(lua, lua_upvalueindex(1)));
    const SystemWord& word = host.all[static_cast<std::size_t>(lua_tointeger(lua, lua_upvalueindex(2)))];
    const bool method = lua_toboolean(lua, lua_upvalueindex(3)) != 0;
    Result result;
    bridge(lua, [&] { return run_word(lua, host, word, method).map([&](const Result& made) { result = made; }); });
    if (const auto* thing = std::get_if<FileThing>(&result.made)) {
        push_file_thing(lua, *thing, host.words->facts(*thing));
        return 1;
    }
    if (const auto* value = std::get_if<Value>(&result.made)) {
        push_payload(lua, *value);
        return 1;
    }
    if (std::holds_alternative<AddedEntry>(result.made)) return push_entry(lua, host);
    if (const auto* pending = std::get_if<PendingEntry>(&result.made)) {
        lua_pushvalue(lua, lua_upvalueindex(1));
        lua_pushinteger(lua, static_cast<lua_Integer>(pending->index));
        lua_pushcclosure(lua, take_table, 2);
        return 1;
    }
    return 0;
}

void add_system_words(lua_State* lua, WordHost& host, bool methods) {
    lua_Integer number = 0;
    for (const SystemWord& word : host.all) {
        lua_pushlstring(lua, word.name.data(), word.name.size());
        lua_pushlightuserdata(lua, &host);
        lua_pushinteger(lua, number++);
        lua_pushboolean(lua, methods ? 1 : 0);
        lua_pushcclosure(lua, call_system_word, 3);
        lua_rawset(lua, -3);
    }
}

}  // namespace nezumi
