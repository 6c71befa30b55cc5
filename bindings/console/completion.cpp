// What could stand before the cursor.
#include <algorithm>

#include "bindings/console/session_parts.hpp"

namespace nezumi {

Completion Session::complete(std::string_view text, std::size_t cursor) const {
    text = text.substr(0, cursor);
    Completion completion{text.size(), {}};
    return completion;
}

}  // namespace nezumi
