// libsodium's SHA-256, printed as sha256sum does.
#include "bindings/push/content_hash.hpp"

#include <array>

namespace nezumi::push {

ContentHash::ContentHash() { crypto_hash_sha256_init(&state_); }

void ContentHash::add(std::string_view bytes) {
    crypto_hash_sha256_update(&state_, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
}

std::string ContentHash::digits() {
    std::array<unsigned char, crypto_hash_sha256_BYTES> digest{};
    crypto_hash_sha256_final(&state_, digest.data());
    std::array<char, 2 * crypto_hash_sha256_BYTES + 1> text{};
    sodium_bin2hex(text.data(), text.size(), digest.data(), digest.size());
    return text.data();
}

}  // namespace nezumi::push
