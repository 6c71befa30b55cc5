// The hash for comparing contents: SHA-256.
#pragma once

#include <sodium.h>

#include <string>
#include <string_view>

namespace nezumi::push {

class ContentHash {
public:
    ContentHash();
    void add(std::string_view bytes);
    /// Returns 64 digits. Call it once, after all data.
    std::string digits();

private:
    crypto_hash_sha256_state state_;
};

}  // namespace nezumi::push
