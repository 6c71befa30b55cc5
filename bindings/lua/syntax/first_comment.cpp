// Reads comments while each one is in the line after the previous one.
#include "bindings/lua/syntax/first_comment.hpp"

#include <algorithm>

#include "bindings/lua/syntax/lexer.hpp"
#include "engine/base/trimmed.hpp"

namespace nezumi {
namespace {

constexpr std::size_t most = 2000;  // [bytes]

}  // namespace

std::string first_comment(std::string_view source) {
    Lexer lexer(without_preamble(source));
    std::string text;
    int line = 0;
    for (Token token = lexer.next(); token.kind == Token::Kind::comment; token = lexer.next()) {
        std::string_view said = token.text;
        if (token.line > line + 1 && !text.empty()) break;
        if (token.is_long()) break;
        said.remove_prefix(std::min(said.find_first_not_of('-'), said.size()));
        said = trimmed(said);
        if (text.size() + said.size() >= most) break;
        if (!text.empty()) text += '\n';
        text += said;
        line = token.line;
    }
    return text.substr(0, text.find_last_not_of('\n') + 1);
}

}  // namespace nezumi
