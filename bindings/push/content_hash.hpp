// The hash for comparing contents: libsodium's SHA-256.
#pragma once

#include <sodium.h>

#include <array>
#include <string>
#include <string_view>

namespace nezumi::push {

class ContentHash {
public:
    ContentHash() { crypto_hash_sha256_init(&state_); }
    void add(std::string_view bytes) {
        crypto_hash_sha256_update(&state_, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    }
    /// Returns 64 digits, as sha256sum prints them. Call it once, after all data.
    std::string digits() {
        std::array<unsigned char, crypto_hash_sha256_BYTES> digest{};
        crypto_hash_sha256_final(&state_, digest.data());
        std::array<char, 2 * crypto_hash_sha256_BYTES + 1> text{};
        sodium_bin2hex(text.data(), text.size(), digest.data(), digest.size());
        return text.data();
    }

private:
    crypto_hash_sha256_state state_;
};

}  // namespace nezumi::push
