// Tokens before Lua's compiler, twice: first as an expression.
#include "bindings/console/input_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <optional>
#include <vector>

#include "bindings/lua/sandbox/lexer.hpp"
#include "engine/base/names.hpp"

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

namespace {

// What a text in quotes holds, if that is a name.
std::optional<std::string_view> quoted_name(const Token& token) {
    if (token.kind != Token::Kind::literal || token.open || token.text.size() < 2) return std::nullopt;
    const std::string_view name = token.text.substr(1, token.text.size() - 2);
    return is_identifier(name) || is_keyword(name) ? std::optional(name) : std::nullopt;
}

// The chain of names that the tokens from `at` on are, if a comma or bracket ends it; `at` is behind it then.
std::optional<std::vector<std::string>> read_chain(const std::vector<Token>& tokens, std::size_t& at) {
    std::vector<std::string> chain;
    std::size_t next = at;
    const auto is = [&](std::size_t ahead, std::string_view sign) {
        return next + ahead < tokens.size() && tokens[next + ahead].is(sign);
    };
    const auto is_index = [](const Token& token) {
        return token.kind == Token::Kind::literal && std::all_of(token.text.begin(), token.text.end(), [](char c) {
                   return std::isdigit(static_cast<unsigned char>(c)) != 0;
               });
    };
    if (next >= tokens.size() || tokens[next].kind != Token::Kind::name) return std::nullopt;
    chain.emplace_back(tokens[next++].text);
    while (!is(0, ",") && !is(0, ")")) {
        if (is(0, ".") && next + 1 < tokens.size() &&
            (tokens[next + 1].kind == Token::Kind::name || tokens[next + 1].kind == Token::Kind::keyword)) {
            chain.push_back("." + std::string(tokens[next + 1].text));
            next += 2;
        } else if (is(0, "[") && is(2, "]") && is_index(tokens[next + 1])) {
            chain.push_back("[" + std::string(tokens[next + 1].text) + "]");
            next += 3;
        } else if (is(0, "[") && is(2, "]") && quoted_name(tokens[next + 1])) {
            chain.push_back("." + std::string(*quoted_name(tokens[next + 1])));
            next += 3;
        } else {
            return std::nullopt;
        }
    }
    at = next;
    return chain;
}

// What is no port, but can be followed as one.
bool is_followed_member(std::string_view member) {
    return member == ".collided" || member == ".config" || member == ".probes" || member == ".state" ||
           member == ".tasks" || member == ".truth";
}

}  // namespace

std::string with_plotted_names(std::string_view text) {
    std::vector<Token> tokens;
    Lexer lexer(text);
    for (Token token = lexer.next(); token.kind != Token::Kind::end; token = lexer.next()) tokens.push_back(token);
    std::string changed;
    std::size_t copied = 0;
    for (std::size_t at = 0; at + 1 < tokens.size(); ++at) {
        const bool is_member = at > 0 && (tokens[at - 1].is(".") || tokens[at - 1].is(":"));
        if (tokens[at].kind != Token::Kind::name || tokens[at].text != "plot" || is_member || !tokens[at + 1].is("("))
            continue;
        for (std::size_t next = at + 2; next < tokens.size(); ++next) {
            const Token& first = tokens[next];
            const auto chain = read_chain(tokens, next);
            if (!chain) break;
            const bool is_part = chain->size() > 2 || (chain->size() == 2 &&
                                                       ((*chain)[1].front() == '[' || is_followed_member((*chain)[1])));
            if (is_part) {
                const auto from = static_cast<std::size_t>(first.text.data() - text.data());
                const Token& last = tokens[next - 1];
                const auto to = static_cast<std::size_t>(last.text.data() - text.data()) + last.text.size();
                changed.append(text.substr(copied, from - copied));
                changed.append(
                    fmt::format("{{ {}, \"{}\" }}", chain->front(), fmt::join(chain->begin() + 1, chain->end(), "")));
                const std::string_view replaced = text.substr(from, to - from);
                changed.append(static_cast<std::size_t>(std::count(replaced.begin(), replaced.end(), '\n')), '\n');
                copied = to;
            }
            if (tokens[next].is(")")) break;
        }
    }
    return changed.append(text.substr(copied));
}

Expected<Chunk> compile_input(std::string_view text) {
    if (text.size() > longest_input) return failure("the input is too long: at most 64 KB");
    const std::string lua = with_keyword_names(with_plotted_names(text));
    if (auto expression = compile("return " + lua, input_name)) return expression;
    return compile(lua, input_name);
}

bool is_complete_input(std::string_view text) {
    // A line ends here: a quoted text that is open is a mistake, and no text to be continued.
    const std::string lua = with_keyword_names(with_plotted_names(text)) + "\n";
    const auto expression = compile("return " + lua, input_name);
    if (expression) return true;
    const auto statements = compile(lua, input_name);
    return statements || (!lacks_an_end(expression.error()) && !lacks_an_end(statements.error()));
}

}  // namespace nezumi
