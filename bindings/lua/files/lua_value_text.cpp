// Values as a file writes them.
#include "bindings/lua/files/lua_value_text.hpp"

#include "engine/base/names.hpp"

namespace nezumi {

std::string lua_number(double value) {
    std::string text = fmt::format("{}", value);
    if (text.find_first_of(".e") == std::string::npos) text += ".0";
    return text;
}

std::string quoted(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            out += '\\';
            out += c;
        } else if (byte < 0x20 || byte == 0x7f) {
            out += fmt::format("\\x{:02x}", byte);
        } else {
            out += c;
        }
    }
    return out + "\"";
}

std::string lua_key(const std::string& name) { return is_identifier(name) ? name : "[" + quoted(name) + "]"; }

std::string to_lua(const ParameterValue& value) {
    return std::visit(
        [](const auto& v) -> std::string {
            using T = std::decay_t<decltype(v)>;
            if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
                return lua_text(v);
            } else {
                std::string text;
                for (std::size_t i = 0; i < v.size(); ++i) {
                    text += (i > 0 ? ", " : " ") + lua_text(static_cast<typename T::value_type>(v[i]));
                }
                return text.empty() ? "{}" : "{" + text + " }";
            }
        },
        value);
}

std::string detail::lua_list(std::span<const double> numbers) {
    std::string text;
    for (const double number : numbers) text += (text.empty() ? "{ " : ", ") + lua_number(number);
    return text + " }";
}

}  // namespace nezumi
