// Access control: a request that is not exactly as expected is refused.
#include "bindings/web/access.hpp"

#include <sys/random.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "engine/base/trimmed.hpp"

namespace nezumi::web {
namespace {

// Returns TOKEN of the protocols "nezumi, token.TOKEN", in any order; "" for any other text.
std::string_view token_in(std::string_view protocols) {
    constexpr std::string_view prefix = "token.";
    const auto comma = protocols.find(',');
    if (comma == std::string_view::npos) return {};
    std::string_view first = trimmed(protocols.substr(0, comma));
    std::string_view second = trimmed(protocols.substr(comma + 1));
    if (first != "nezumi") std::swap(first, second);
    if (first != "nezumi" || !second.starts_with(prefix)) return {};
    return second.substr(prefix.size());
}

}  // namespace

std::string make_token() {
    std::array<std::uint8_t, 16> bytes{};
    if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) return "";
    constexpr std::string_view digits = "0123456789abcdef";
    std::string token;
    for (const std::uint8_t byte : bytes) {
        token += digits[byte >> 4U];
        token += digits[byte & 15U];
    }
    return token;
}

bool is_same_secret(std::string_view left, std::string_view right) {
    // Texts of different lengths may end the comparison early, because the length of our token is no secret.
    if (left.size() != right.size() || left.empty()) return false;
    volatile unsigned difference = 0;
    for (std::size_t i = 0; i < left.size(); ++i)
        difference = difference |
                     static_cast<unsigned>(static_cast<unsigned char>(left[i]) ^ static_cast<unsigned char>(right[i]));
    return difference == 0;
}

bool AccessControl::is_own_host(std::string_view host) const {
    const auto bracket = host.find(']');
    const auto colon = host.find(':', bracket == std::string_view::npos ? 0 : bracket);
    const std::string_view name = host.substr(0, colon);
    if (colon != std::string_view::npos) {
        const std::string_view port = host.substr(colon + 1);
        const bool digits = std::all_of(port.begin(), port.end(), [](char each) { return each >= '0' && each <= '9'; });
        if (port.empty() || port.size() > 5 || !digits) return false;
    }
    if (name == "127.0.0.1" || name == "localhost" || name == "[::1]") return true;
    return !address_.empty() && name == address_;
}

std::optional<std::string_view> AccessControl::offered_token(const HttpRequest& request) const {
    if (request.path != "/ws" || !is_own_host(request.host)) return std::nullopt;
    if (request.origin != scheme_ + "://" + std::string(request.host)) return std::nullopt;
    return token_in(request.protocols);
}

Admission AccessControl::check(const HttpRequest& request) const {
    const auto token = offered_token(request);
    if (!token) return {.refused = forbidden};
    const bool acts = is_same_secret(*token, token_);
    const bool views = is_same_secret(*token, view_token_);
    if (!acts && !views) return {.refused = forbidden};
    return {.refused = 0, .view_only = !acts};
}

}  // namespace nezumi::web
