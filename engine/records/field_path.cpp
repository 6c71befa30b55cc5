// A path as messages show it.
#include "engine/records/field_path.hpp"

namespace nezumi {

std::string to_text(const FieldPath& path) {
    std::string text;
    for (const std::string& part : path) {
        if (!text.empty() && !part.starts_with('[')) text += '.';  // a name that a person chose may be empty
        text += part;
    }
    return text;
}

}  // namespace nezumi
