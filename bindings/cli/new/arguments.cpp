// Each value is classified by its first characters, and written in Lua's form.
#include "bindings/cli/new/arguments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <optional>

#include "bindings/lua/syntax/lexer.hpp"
#include "engine/base/list.hpp"
#include "engine/base/lua_text.hpp"
#include "engine/base/names.hpp"
#include "engine/base/number_in.hpp"
#include "engine/base/trimmed.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi::cli {
namespace {

bool is_upper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }
bool is_word(char c) { return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0; }

// Inserts an underscore before each capitalized word: "EV3Follower" becomes ev3_follower.
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
    return finite_in(text).has_value();
}

// True if the whole text is one Lua string.
bool is_string(std::string_view text) {
    if (!text.starts_with('"') && !text.starts_with('\'')) return false;
    const Token token = Lexer(text).next();
    return token.text.size() == text.size() && !token.open && !token.malformed;
}

// Checks an array such as "{1.0,0.5}", and returns it as "{ 1.0, 0.5 }".
Expected<std::string> array_text(std::string_view given) {
    if (!given.ends_with('}')) return failure(fmt::format("'{}' has no }} at its end", shown(given)));
    std::string_view rest = trimmed(given.substr(1, given.size() - 2));
    std::string text;
    while (!rest.empty()) {
        const std::size_t comma = rest.find(',');
        const std::string_view element = trimmed(rest.substr(0, comma));
        auto read = default_text(std::string(element));
        if (element.starts_with('{')) return failure("a parameter can't be an array of arrays");
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
        return failure(fmt::format("'{}' is not a number: write 30, 0.5 or -1e-3, or a string in quotes", shown(text)));
    }
    if (text == "nil")
        return failure("nil can't be a default: expected a number, true, false, a string or { 1.0, 0.5 }");
    if (const std::string near = did_you_mean(text, {"true", "false"}); !near.empty()) {
        return failure(fmt::format("'{}'{}; a string like this needs quotes", shown(text), near));
    }
    return lua_quoted(given);
}

Expected<std::string> new_file_name(std::string_view what_it_is, const std::string& given) {
    if (given.empty()) return failure(fmt::format("a {} needs a name, for example line_follower", what_it_is));
    std::string name = to_snake(given);
    if (is_identifier(name) && !name.ends_with("_test")) return name;
    const std::string what = fmt::format("'{}' can't be a {}'s name", shown(given), what_it_is);
    if (name.ends_with("_test")) return failure(what + ": files named *_test.lua are scenarios");
    if (is_keyword(name)) return failure(what + ": it is a keyword of Lua");
    std::string near = given.ends_with(".lua") ? given.substr(0, given.size() - 4) : given;
    near.erase(0, near.rfind('/') + 1);
    std::replace_if(
        near.begin(), near.end(), [](char c) { return !is_word(c); }, '_');
    near = to_snake(near);
    const bool helps = is_identifier(near) && near.find_first_not_of('_') != near.npos && near.size() <= 60;
    return failure(what + ": letters, digits and _, not beginning with a digit" +
                   (helps ? fmt::format(" (did you mean '{}'?)", near) : ", for example line_follower"));
}

Expected<void> take_new_name(std::string_view option, const std::string& name, std::vector<std::string>& taken) {
    if (!is_identifier(name) && !is_keyword(name)) {
        return failure(fmt::format("{} '{}': a name consists of letters, digits and _, and does not begin with a digit",
                                   option, shown(name)));
    }
    if (contains(taken, name)) return failure(fmt::format("{} '{}': the name is given twice", option, shown(name)));
    taken.push_back(name);
    return {};
}

namespace {

// The options that may follow a default, in the order of writing.
constexpr std::string_view parameter_options[] = {"min", "max", "step", "choices", "widget", "unit", "doc"};

// Returns the word between the comma and an equals sign: "min" for ",min="; "" if these do not follow.
std::string_view option_after(std::string_view text, std::size_t comma) {
    std::size_t begin = comma + 1;
    while (begin < text.size() && text[begin] == ' ') ++begin;
    std::size_t end = begin;
    while (end < text.size() && is_word(text[end])) ++end;
    return end > begin && end < text.size() && text[end] == '=' ? text.substr(begin, end - begin) : "";
}

Expected<std::string> option_text(std::string_view option, const std::string& value) {
    if (option == "unit" || option == "doc" || option == "widget") return lua_quoted(value);
    auto text = default_text(value);
    if (!text) return failure(fmt::format("{}: {}", option, text.error().message));
    if (option == "choices") {
        if (text->starts_with('{')) return text;
        return failure(fmt::format("choices: expected {{ a, b }}, got '{}'", shown(value)));
    }
    if (is_number(*text)) return text;
    return failure(fmt::format("{}: expected a number, got '{}'", option, shown(value)));
}

}  // namespace

Expected<NewParameter> read_new_parameter(const std::string& given) {
    const std::size_t equals = given.find('=');
    if (equals == std::string::npos) {
        return failure(fmt::format("--param '{}': expected name=default, for example --param speed=0.1", shown(given)));
    }
    NewParameter read{given.substr(0, equals), "", ""};
    const auto wrong = [&](const std::string& why) {
        return failure(fmt::format("--param '{}': {}", shown(read.name), why));
    };
    const std::vector<std::string_view> known(std::begin(parameter_options), std::end(parameter_options));
    std::vector<std::optional<std::string>> values(known.size());
    const std::string_view text = given;
    std::optional<std::size_t> option;  // none: the default
    for (std::size_t begin = equals + 1; begin <= text.size();) {
        std::size_t end = begin;
        std::string_view next;
        for (; end < text.size() && next.empty(); ++end) {
            if (text[end] != ',') continue;
            const std::string_view word = option_after(text, end);
            if (word.empty()) continue;
            if (contains(known, word)) {
                next = word;
                break;
            }
            // An unknown word may be part of the value, but a misspelled option is an error.
            if (const std::string near = did_you_mean(word, known); !near.empty())
                return wrong(fmt::format("there is no '{}'{}", word, near));
        }
        const std::string value(text.substr(begin, end - begin));
        auto written = option ? option_text(known[*option], value) : default_text(value);
        if (!written) return wrong(written.error().message);
        if (!option) {
            read.initial = std::move(*written);
        } else if (values[*option]) {
            return wrong(fmt::format("'{}' is given twice", known[*option]));
        } else {
            values[*option] = std::move(*written);
        }
        if (next.empty()) break;
        option = static_cast<std::size_t>(std::find(known.begin(), known.end(), next) - known.begin());
        begin = text.find('=', end) + 1;
    }
    if (!values.back()) values.back() = lua_quoted("read as config." + read.name);
    for (std::size_t i = 0; i < known.size(); ++i) {
        if (values[i]) read.options += fmt::format("{}{} = {}", read.options.empty() ? "" : ", ", known[i], *values[i]);
    }
    return read;
}

}  // namespace nezumi::cli
