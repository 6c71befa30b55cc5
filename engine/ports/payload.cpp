// Names of leaves, hashing of bytes, and payloads whose type is only known at run time.
#include "engine/ports/payload.hpp"

#include <cstring>

namespace nezumi {

std::string LeafPath::text() const {
    if (parent_ == nullptr) return "";
    std::string text = parent_->text();
    if (index_ > 0) return text + "[" + std::to_string(index_) + "]";
    if (!text.empty() && !name_.starts_with('[')) text += '.';
    return text.append(name_);
}

std::uint64_t mix(std::uint64_t seed, std::string_view bytes) {
    seed = mix(seed, bytes.size());
    while (!bytes.empty()) {
        std::uint64_t word = 0;
        const std::size_t n = bytes.size() < sizeof word ? bytes.size() : sizeof word;
        std::memcpy(&word, bytes.data(), n);
        seed = mix(seed, word);
        bytes.remove_prefix(n);
    }
    return seed;
}

bool is_finite(const AnyPayload& value) {
    return std::visit([](const auto& payload) { return is_finite(payload); }, value);
}

}  // namespace nezumi
