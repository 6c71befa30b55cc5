// JSON exactly as rosidl writes it before it takes SHA-256: ", " and ": ", types by name, no default values.
#include "bindings/dds/ros/type_hash.hpp"

#include <fmt/format.h>
#include <sodium.h>

namespace nezumi::ros {
namespace detail {
namespace {

std::string type_text(std::string_view name, std::string_view fields) {
    return fmt::format(R"({{"type_name": "{}", "fields": [{}]}})", name, fields);
}

}  // namespace

std::string field_text(std::string_view name, int type, std::size_t capacity, std::string_view nested) {
    return fmt::format(
        R"({{"name": "{}", "type": {{"type_id": {}, "capacity": {}, "string_capacity": 0, "nested_type_name": "{}"}}}})",
        name, type, capacity, nested);
}

std::string hash_of_description(std::string_view name, const std::map<std::string, std::string, std::less<>>& all) {
    std::string others;
    for (const auto& [other, fields] : all) {
        if (other != name) others += (others.empty() ? "" : ", ") + type_text(other, fields);
    }
    const std::string json = fmt::format(R"({{"type_description": {}, "referenced_type_descriptions": [{}]}})",
                                         type_text(name, all.find(name)->second), others);
    std::array<unsigned char, crypto_hash_sha256_BYTES> digest{};
    crypto_hash_sha256(digest.data(), reinterpret_cast<const unsigned char*>(json.data()), json.size());
    std::string text = "RIHS01_";
    for (const unsigned char byte : digest) text += fmt::format("{:02x}", byte);
    return text;
}

}  // namespace detail

std::string dds_type_name(std::string_view name) {
    std::string text;
    for (const char c : name) text += c == '/' ? std::string("::") : std::string(1, c);
    const std::size_t last = text.rfind("::");
    return text.substr(0, last) + "::dds_" + text.substr(last) + "_";
}

}  // namespace nezumi::ros
