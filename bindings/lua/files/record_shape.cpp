// Words for what may stand in a field.
#include "bindings/lua/files/record_shape.hpp"

#include <cctype>

namespace nezumi {

std::string class_of(std::string_view record) {
    std::string name;
    bool is_first = true;
    for (const char c : record) {
        if (c != '_') name += is_first ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
        is_first = c == '_';
    }
    return name.ends_with("Options") ? name : name + "Fields";
}

namespace detail {

std::string list_of(std::span<const std::string_view> names, bool quoted, std::string_view separator) {
    std::string text;
    for (const std::string_view name : names) {
        if (!text.empty()) text += separator;
        text += quoted ? "\"" + std::string(name) + "\"" : std::string(name);
    }
    return text;
}

}  // namespace detail
}  // namespace nezumi
