// Reads what a person writes on the command line: names and defaults.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string_view>

#include "bindings/cli/new_behavior.hpp"
#include "bindings/lua/sandbox/lexer.hpp"
#include "engine/base/names.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi::cli {
namespace {

bool is_upper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }
bool is_word(char c) { return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0; }

// An underscore before each word that begins with a capital: "EV3Follower" is ev3_follower.
std::string to_snake(std::string_view name) {
    std::string snake;
    for (std::size_t i = 0; i < name.size(); ++i) {
        const bool after_word = i > 0 && name[i - 1] != '_' && !is_upper(name[i - 1]);
        const bool ends_capitals = i > 0 && i + 1 < name.size() && is_upper(name[i - 1]) &&
                                   std::islower(static_cast<unsigned char>(name[i + 1])) != 0;
        if (is_upper(name[i]) && (after_word || ends_capitals)) snake += '_';
        snake += static_cast<char>(std::tolower(static_cast<unsigned char>(name[i])));
    }
    return snake;
}

bool is_number(std::string_view text) {
    if (text.starts_with('-')) text.remove_prefix(1);
    if (text.empty() || (std::isdigit(static_cast<unsigned char>(text.front())) == 0 && text.front() != '.'))
        return false;
    double value = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    return problem == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

std::string quoted(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') out += '\\';
        if (byte < 0x20 || byte == 0x7f) {
            out += fmt::format("\\{:03}", byte);
        } else {
            out += c;
        }
    }
    return out + '"';
}

// A whole text that is one string of Lua.
bool is_string(std::string_view text) {
    if (!text.starts_with('"') && !text.starts_with('\'')) return false;
    Lexer lexer(text);
    const Token token = lexer.next();
    return token.kind == Token::Kind::literal && token.text.size() == text.size() && text.size() >= 2 &&
           text.back() == text.front();
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
    return text;
}

// { 1.0, 0.5 }
Expected<std::string> array_text(std::string_view given) {
    if (!given.ends_with('}')) return failure(fmt::format("'{}' has no }} at its end", shown(given)));
    std::string_view rest = trimmed(given.substr(1, given.size() - 2));
    std::string text;
    while (!rest.empty()) {
        const std::size_t comma = rest.find(',');
        const std::string_view element = trimmed(rest.substr(0, comma));
        auto read = default_text(std::string(element));
        if (element.starts_with('{')) return failure("arrays of arrays are no parameters");
        if (!read) return read;
        text += (text.empty() ? "" : ", ") + *read;
        rest = comma == std::string_view::npos ? std::string_view() : trimmed(rest.substr(comma + 1));
    }
    if (text.empty()) return failure("an empty array has no type: write at least one element");
    return "{ " + text + " }";
}

}  // namespace

Expected<std::string> default_text(const std::string& given) {
    const std::string_view text = trimmed(given);
    if (text == "true" || text == "false" || is_string(text)) return std::string(text);
    if (text.starts_with('{')) return array_text(text);
    const std::string_view number = text.starts_with('+') ? text.substr(1) : text;
    if (is_number(number)) return std::string(number);
    const bool looks_like_number =
        !text.empty() && std::string_view("0123456789.+-").find(text.front()) != std::string_view::npos;
    if (looks_like_number || text == "nan" || text == "inf") {
        return failure(fmt::format("'{}' is no number: write 30, 0.5 or -1e-3, or a text in quotes", shown(text)));
    }
    if (text == "nil") return failure("nil is no default: expected a number, true, false, a text or { 1.0, 0.5 }");
    if (const std::string near = did_you_mean(text, {"true", "false"}); !near.empty()) {
        return failure(fmt::format("'{}'{}; a text like this needs quotes", shown(text), near));
    }
    return quoted(given);
}

Expected<std::string> behavior_file_name(const std::string& given) {
    if (given.empty()) return failure("a behaviour needs a name, for example line_follower");
    std::string name = to_snake(given);
    if (is_identifier(name) && !name.ends_with("_test")) return name;
    const std::string what = fmt::format("'{}' can't be a behaviour's name", shown(given));
    if (name.ends_with("_test")) return failure(what + ": files called *_test.lua are scenarios");
    if (is_keyword(name)) return failure(what + ": it is a word of Lua");
    std::string near = given.ends_with(".lua") ? given.substr(0, given.size() - 4) : given;
    near.erase(0, near.rfind('/') + 1);
    std::replace_if(
        near.begin(), near.end(), [](char c) { return !is_word(c); }, '_');
    near = to_snake(near);
    const bool helps = is_identifier(near) && near.size() <= 60;
    return failure(what + ": letters, digits and _, not beginning with a digit" +
                   (helps ? fmt::format(" (did you mean '{}'?)", near) : ""));
}

}  // namespace nezumi::cli
