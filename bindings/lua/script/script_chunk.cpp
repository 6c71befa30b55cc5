// What scripts may name, and what they write by mistake although Lua takes it.
#include "bindings/lua/script/script_chunk.hpp"

#include <algorithm>

#include "bindings/lua/sandbox/lexer.hpp"
#include "bindings/lua/sandbox/stdlib.hpp"
#include "bindings/lua/script/script_words.hpp"

namespace nezumi {
namespace {

const KnownGlobals& known_globals(ScriptKind kind) {
    static const KnownGlobals components = [] {
        KnownGlobals known{script_words(), hook_names()};
        known.readable.insert(known.readable.end(), sandbox_names().begin(), sandbox_names().end());
        return known;
    }();
    static const KnownGlobals modules = [] {
        KnownGlobals known = components;
        known.callbacks.clear();
        return known;
    }();
    return kind == ScriptKind::component ? components : modules;
}

// `local function on_execute` and `local on_execute =` are Lua, and nobody would ever call it.
void find_local_callbacks(const SourceText& source, std::vector<Error>& errors) {
    const auto& names = hook_names();
    Lexer lexer(source.text);
    bool after_local = false;
    for (Token token = lexer.next(); token.kind != Token::Kind::end; token = lexer.next()) {
        if (after_local && token.is("function")) continue;
        if (after_local && token.kind == Token::Kind::name &&
            std::find(names.begin(), names.end(), token.text) != names.end()) {
            errors.push_back(
                {"'" + std::string(token.text) + "' is local, so it would never be called: leave out `local`",
                 {source.shown, token.line, token.column}});
        }
        after_local = token.is("local");
    }
}

// A module's callback would be no global that it may define.
void explain_callbacks(std::vector<Error>& errors) {
    for (Error& error : errors) {
        for (const std::string_view name : hook_names()) {
            const std::string quoted = "'" + std::string(name) + "'";
            if (error.message.find("unknown global " + quoted) != 0) continue;
            error.message = quoted + " can't be used in a module: callbacks belong into the component's own file";
            break;
        }
    }
}

}  // namespace

tl::expected<Chunk, std::vector<Error>> compile_script(const SourceText& source, ScriptKind kind) {
    auto chunk = compile_checked(source.text, source.shown, known_globals(kind));
    std::vector<Error> errors;
    if (!chunk) errors = std::move(chunk.error());
    const bool compiles = chunk || errors.size() != 1 || errors.front().place.column > 0;
    if (compiles && kind == ScriptKind::component) {
        find_local_callbacks(source, errors);
        std::stable_sort(errors.begin(), errors.end(), [](const Error& a, const Error& b) {
            return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
        });
    }
    if (kind == ScriptKind::module) explain_callbacks(errors);
    if (!errors.empty()) return tl::unexpected(std::move(errors));
    return chunk;
}

Expected<Chunk> ChunkCache::compile(const SourceText& source, ScriptKind kind) {
    const std::lock_guard lock(mutex_);
    Entry& entry = entries_[source.path + '\n' + source.shown + (kind == ScriptKind::module ? "\nmodule" : "\n")];
    if (!entry.chunk.bytecode.empty() && entry.text == source.text) return entry.chunk;
    auto chunk = compile_script(source, kind);
    if (!chunk) return Unexpected(chunk.error().front());
    entry = {source.text, *chunk};
    return std::move(*chunk);
}

}  // namespace nezumi
