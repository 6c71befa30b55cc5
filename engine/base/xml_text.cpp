// Writes line ends and tabs as character references, because XML readers replace them by blanks in attributes.
#include "engine/base/xml_text.hpp"

#include <cstddef>

#include "engine/base/utf8.hpp"

namespace nezumi {
namespace {

// The number of bytes of the character at `at`; 0 for a carriage return, or if XML does not allow the character.
std::size_t character_size(std::string_view text, std::size_t at) {
    const auto [size, code] = utf8_character(text, at);
    const bool is_control = code < 0x20 && code != '\n' && code != '\t';
    return is_control || code == 0xfffe || code == 0xffff ? 0 : size;
}

}  // namespace

std::string xml_text(std::string_view text) {
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t size = character_size(text, at);
        switch (size == 1 ? text[at] : '\0') {
            case '&': out += "&amp;"; break;
            case '<': out += "&lt;"; break;
            case '>': out += "&gt;"; break;
            case '"': out += "&quot;"; break;
            case '\n': out += "&#10;"; break;
            case '\t': out += "&#9;"; break;
            default: size == 0 ? out += '?' : out.append(text.substr(at, size));
        }
        at += size == 0 ? 1 : size;
    }
    return out;
}

}  // namespace nezumi
