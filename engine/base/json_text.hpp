// JSON as text that every program can read.
#pragma once

#include <string>

namespace nezumi {

/// Returns JSON (nlohmann's, ordered or not) in one line; invalid UTF-8 becomes U+FFFD.
template <typename Json>
std::string json_text(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace nezumi
