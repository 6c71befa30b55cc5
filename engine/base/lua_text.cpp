// Uses only escapes that both Lua and YAML understand.
#include "engine/base/lua_text.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "engine/base/names.hpp"

namespace nezumi {

std::string lua_quoted(std::string_view text) {
    std::string all = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            all += '\\';
            all += c;
        } else if (c == '\n') {
            all += "\\n";
        } else if (byte < 0x20 || byte == 0x7f) {
            all += fmt::format("\\x{:02x}", byte);
        } else {
            all += c;
        }
    }
    return all + '"';
}

std::string lua_unquoted(std::string_view quoted) {
    std::string text;
    for (std::size_t i = 1; i + 1 < quoted.size(); ++i) {
        const bool is_escaped = quoted[i] == '\\';
        if (is_escaped) ++i;
        if (is_escaped && quoted[i] == 'x') {
            const std::string_view digits = quoted.substr(i + 1, 2);
            unsigned byte = 0;
            std::from_chars(digits.data(), digits.data() + digits.size(), byte, 16);
            text += static_cast<char>(byte);
            i += 2;
        } else {
            text += is_escaped && quoted[i] == 'n' ? '\n' : quoted[i];
        }
    }
    return text;
}

std::string lua_key(std::string_view name) {
    return is_identifier(name) ? std::string(name) : "[" + lua_quoted(name) + "]";
}

std::string lua_number(double value) {
    if (std::isnan(value)) return "nan";
    std::string text = fmt::format("{}", value);
    if (text.find_first_not_of("-0123456789") == std::string::npos) text += ".0";
    return text;
}

}  // namespace nezumi
