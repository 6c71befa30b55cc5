// Values as a file writes them.
#include "bindings/lua/files/lua_value_text.hpp"

#include "engine/base/names.hpp"

namespace nezumi {

std::string lua_key(const std::string& name) { return is_identifier(name) ? name : "[" + lua_quoted(name) + "]"; }

std::string detail::lua_list(std::span<const double> numbers) {
    std::string text;
    for (const double number : numbers) text += (text.empty() ? "{ " : ", ") + lua_number(number);
    return text + " }";
}

}  // namespace nezumi
