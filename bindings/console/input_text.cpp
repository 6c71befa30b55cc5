// Tokens before Lua's compiler, twice: first as an expression.
#include "bindings/console/input_text.hpp"

#include <cstddef>

#include "bindings/lua/sandbox/lexer.hpp"

namespace nezumi {
namespace {

constexpr std::size_t longest_input = std::size_t{64} << 10;  // [bytes]

bool lacks_an_end(const Error& error) {
    return error.message.ends_with("near <eof>") || error.message.ends_with("near '<eof>'");
}

}  // namespace

std::string with_keyword_names(std::string_view text) {
    std::string changed;
    std::size_t copied = 0;
    Lexer lexer(text);
    bool after_value = false;
    const char* dot = nullptr;  // of a dot that follows a value
    for (Token token = lexer.next(); token.kind != Token::Kind::end; token = lexer.next()) {
        if (dot != nullptr && token.kind == Token::Kind::keyword) {
            const auto from = static_cast<std::size_t>(dot - text.data());
            const auto to = static_cast<std::size_t>(token.text.data() - text.data());
            changed.append(text.substr(copied, from - copied));
            changed.append("[\"").append(token.text).append("\"]");
            changed.append(text.substr(from + 1, to - from - 1));  // blanks and ends of lines
            copied = to + token.text.size();
            after_value = true;
            dot = nullptr;
            continue;
        }
        dot = after_value && token.is(".") ? token.text.data() : nullptr;
        after_value = token.kind == Token::Kind::name || token.is(")") || token.is("]");
    }
    return changed.append(text.substr(copied));
}

Expected<Chunk> compile_input(std::string_view text) {
    if (text.size() > longest_input) return failure("the input is too long: at most 64 KB");
    const std::string lua = with_keyword_names(text);
    if (auto expression = compile("return " + lua, input_name)) return expression;
    return compile(lua, input_name);
}

bool is_complete_input(std::string_view text) {
    // A line ends here: a quoted text that is open is a mistake, and no text to be continued.
    const std::string lua = with_keyword_names(text) + "\n";
    const auto expression = compile("return " + lua, input_name);
    if (expression) return true;
    const auto statements = compile(lua, input_name);
    return statements || (!lacks_an_end(expression.error()) && !lacks_an_end(statements.error()));
}

}  // namespace nezumi
