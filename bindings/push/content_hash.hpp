// The hash by which contents are compared: SHA-256.
#pragma once

#include <sodium.h>

#include <string>
#include <string_view>

namespace nezumi::push {

class ContentHash {
public:
    ContentHash();
    void add(std::string_view bytes);
    /// 64 digits. Once, after all was added.
    std::string digits();

private:
    crypto_hash_sha256_state state_;
};

}  // namespace nezumi::push
