// A path as messages show it.
#include "engine/records/field_path.hpp"

namespace nezumi {

std::string to_text(const FieldPath& path) {
    std::string text;
    for (const std::string& part : path) {
        if (!text.empty() && !part.starts_with('[')) text += '.';  // a part may be empty: a person chose the name
        text += part;
    }
    return text;
}

}  // namespace nezumi
