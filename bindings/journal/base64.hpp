// Base64: bytes as text of 64 letters (RFC 4648).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace nezumi {

std::string to_base64(std::string_view bytes);
/// Returns nothing for an invalid text.
std::optional<std::string> from_base64(std::string_view text);

}  // namespace nezumi
