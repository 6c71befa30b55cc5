// Compiles in a separate state, and keeps the bytecode.
#include "bindings/lua/sandbox/compile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "bindings/lua/sandbox/bytecode.hpp"
#include "bindings/lua/sandbox/state.hpp"
#include "bindings/lua/syntax/other_languages.hpp"
#include "engine/base/visible.hpp"

namespace nezumi {
namespace {

// Gives the text to Lua in pieces, and stops if compiling takes too long, because no hook runs in the compiler.
struct SourceReader {
    std::string_view rest;
    std::size_t piece;
    std::int64_t deadline;

    static const char* read(lua_State* lua, void* self, std::size_t* size) {
        auto& reader = *static_cast<SourceReader*>(self);
        if (thread_time() > reader.deadline) luaL_error(lua, "takes too long to compile");
        const std::string_view given = reader.rest.substr(0, reader.piece);
        reader.rest.remove_prefix(given.size());
        *size = given.size();
        return given.data();
    }
};

int append_bytecode(lua_State*, const void* bytes, std::size_t size, void* text) {
    static_cast<std::string*>(text)->append(static_cast<const char*>(bytes), size);
    return 0;
}

// Lua's message ends with the token, which may be long or unprintable: "unexpected symbol near 'x'".
std::string with_shown_token(std::string_view message) {
    constexpr std::string_view near = " near '";
    const std::size_t at = message.find(near);
    if (at == message.npos || !message.ends_with('\'')) return visible(message);
    const std::string_view token = message.substr(at + near.size(), message.size() - at - near.size() - 1);
    return fmt::format("{}{}{}'", visible(message.substr(0, at)), near, shown(token));
}

// Some errors are found only at the end of a block, and their message names the line: "break outside loop at line 3
// near <eof>".
Error at_its_line(Error error) {
    constexpr std::string_view at_line = " at line ";
    const bool is_jump = error.message.starts_with("break ") || error.message.starts_with("no visible label ") ||
                         error.message.starts_with("<goto ");
    const std::size_t at = error.message.find(at_line);
    if (!is_jump || at == error.message.npos) return error;
    const char* const begin = error.message.data() + at + at_line.size();
    const char* const end = error.message.data() + error.message.size();
    const auto read = std::from_chars(begin, end, error.place.line);
    std::string rest(read.ptr, end);
    if (const std::size_t near = rest.find(" near "); near != rest.npos) rest.erase(near);
    error.message = error.message.substr(0, at) + rest;
    return error;
}

// Separates "file:12: text" into location and text. Lua shortens a long name to its last bytes.
Error place_of_syntax_error(std::string_view message, const std::string& file) {
    std::size_t at = std::min<std::size_t>(file.size(), LUA_IDSIZE - 1);
    int line = 0;
    if (at < message.size() && message[at] == ':') {
        for (++at; at < message.size() && message[at] >= '0' && message[at] <= '9'; ++at) {
            line = line * 10 + (message[at] - '0');
        }
        if (message.substr(at, 2) == ": ") return at_its_line({with_shown_token(message.substr(at + 2)), {file, line}});
    }
    return {with_shown_token(message), {file}};
}

}  // namespace

Expected<Chunk> compile(std::string_view source, const std::string& file) {
    if (source.size() > source_size_limit) return failure("the file is too large: at most 1 MB", {file});
    source = without_preamble(source);
    if (source.substr(0, 1) == std::string_view(LUA_SIGNATURE, 1))
        return failure("this is bytecode: only Lua source text can run", {file, 1});
    if (source.starts_with("\xFF\xFE") || source.starts_with("\xFE\xFF"))
        return failure("this is UTF-16: save the file as UTF-8", {file, 1});
    auto state = LuaState::create();
    if (!state) return Unexpected(state.error());
    lua_State* const lua = (*state)->lua();
    const std::int64_t deadline = thread_time() + static_cast<std::int64_t>(compile_seconds_limit * 1e9);
    SourceReader reader{source, 4096, deadline};
    const std::string chunk_name = "@" + file;
    const int status = lua_load(lua, SourceReader::read, &reader, chunk_name.c_str(), "t");
    if (status == LUA_ERRMEM) return failure("not enough memory to compile it", {file});
    if (status != LUA_OK && std::string_view(lua_tostring(lua, -1)) == "C stack overflow") {
        // This error has no location. Compiles again and gives the text byte by byte, to see how far Lua reads.
        reader = {source, 1, deadline};
        lua_load(lua, SourceReader::read, &reader, chunk_name.c_str(), "t");
        const std::string_view seen = source.substr(0, source.size() - reader.rest.size());
        return failure("the code is nested too deeply",
                       {file, 1 + static_cast<int>(std::count(seen.begin(), seen.end(), '\n'))});
    }
    if (status != LUA_OK) {
        Error error = place_of_syntax_error(lua_tostring(lua, -1), file);
        if (const std::string_view hint = other_language_hint(SyntaxTree(source)); !hint.empty())
            error.message += fmt::format(": {}", hint);
        return Unexpected(std::move(error));
    }
    Chunk chunk{file, {}};
    lua_dump(lua, append_bytecode, &chunk.bytecode, 0);
    chunk.bytecode = with_division_lines(std::move(chunk.bytecode));
    return chunk;
}

tl::expected<Chunk, std::vector<Error>> compile_checked(std::string_view source, const std::string& file,
                                                        const KnownGlobals& known) {
    auto chunk = compile(source, file);
    if (!chunk) return tl::unexpected(std::vector<Error>{chunk.error()});
    std::vector<Error> errors = check_globals(SyntaxTree(without_preamble(source)), file, known);
    if (!errors.empty()) return tl::unexpected(std::move(errors));
    return std::move(*chunk);
}

CallResult load_chunk(lua_State* lua, const Chunk& chunk) {
    return protect(lua, Budget{compile_seconds_limit}, [&chunk](lua_State* inside) {
        if (luaL_loadbufferx(inside, chunk.bytecode.data(), chunk.bytecode.size(), "chunk", "b") != LUA_OK)
            lua_error(inside);
        return 1;
    });
}

}  // namespace nezumi
