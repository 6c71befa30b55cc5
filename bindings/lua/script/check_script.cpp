// Reading finds every diagnostic of the text at once, then loading those of the declarations, then both together those
// of their uses.
#include "bindings/lua/script/check_script.hpp"

#include <fmt/format.h>

#include "bindings/lua/sandbox/globals_scan.hpp"
#include "bindings/lua/sandbox/lexer.hpp"

namespace nezumi {
namespace {

// Every `config.name` of a parameter that the file does not declare: it would fail when that line runs for the first
// time.
std::vector<Error> unknown_parameters(const SourceText& source, const Parameters& parameters) {
    std::vector<std::string_view> names;
    for (const auto& parameter : parameters.all()) names.push_back(parameter.spec.name);
    std::vector<Error> errors;
    Lexer lexer(without_preamble(source.text));
    Token token = lexer.next();
    for (const GlobalUse& use : scan_globals(source.text)) {
        if (use.name != "config") continue;
        while (token.kind != Token::Kind::end && (token.line != use.line || token.column != use.column))
            token = lexer.next();
        if (!(token = lexer.next()).is(".")) continue;
        token = lexer.next();
        if (token.kind != Token::Kind::name || parameters.find(token.text) != nullptr) continue;
        errors.push_back(
            {fmt::format("config: unknown parameter '{}'{}", shown(token.text), did_you_mean(token.text, names)),
             {source.shown, token.line, token.column}});
    }
    return errors;
}

}  // namespace

std::vector<Error> check_behavior(const SourceText& source, const ScriptContext& context) {
    if (auto chunk = compile_script(source, ScriptKind::component); !chunk) return std::move(chunk.error());
    std::vector<Error> diagnostics;
    ScriptContext collecting = context;
    collecting.diagnostics = &diagnostics;
    auto script = Script::load(source, std::move(collecting));
    // What ends the loading after a diagnostic may well follow from it.
    if (!diagnostics.empty()) return diagnostics;
    if (!script) return {std::move(script.error())};
    return unknown_parameters(source, (*script)->parameters());
}

std::vector<Error> check_module(const SourceText& source) {
    auto chunk = compile_script(source, ScriptKind::module);
    return chunk ? std::vector<Error>() : std::move(chunk.error());
}

}  // namespace nezumi
