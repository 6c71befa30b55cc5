// Writes structures as bytes and reads them back: the members in order, numbers as in memory, texts and lists after
// their length, optional values after a flag that tells whether they exist.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/values/members.hpp"

namespace nezumi {

// Results are sent from one machine to another, so all must have this byte order.
static_assert(std::endian::native == std::endian::little);

template <class T>
inline constexpr bool is_list = false;
template <class T>
inline constexpr bool is_list<std::vector<T>> = true;
template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;

/// If only some fields of a structure are archived, a function `each_field(archive, value)` in the namespace of the
/// structure calls the archive with each of these fields, and returns whether all of them were read.
template <class Archive, class AnyError>
requires std::is_same_v<std::remove_const_t<AnyError>, Error>
bool each_field(Archive& archive, AnyError& error) {
    return archive(error.message) && archive(error.place) && archive(error.kind) &&
           error.kind >= Error::Kind::ordinary && error.kind <= Error::Kind::out_of_time;
}

namespace detail {
template <class Archive, class Structure>
bool archive_fields(Archive& archive, Structure& value) {
    if constexpr (requires { each_field(archive, value); }) {
        return each_field(archive, value);
    } else {
        return std::apply([&](auto&... member) { return (archive(member) && ...); }, members_of(value));
    }
}
}  // namespace detail

/// The size of a number must be the same on all machines (no `std::size_t`).
struct ArchiveWriter {
    std::string bytes{};

    template <class T>
    bool operator()(const T& value) {
        if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
            bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
            return true;
        } else if constexpr (std::is_same_v<T, std::string>) {
            (*this)(static_cast<std::uint64_t>(value.size()));
            bytes += value;
            return true;
        } else if constexpr (is_list<T>) {
            (*this)(static_cast<std::uint64_t>(value.size()));
            for (const auto& each : value) (*this)(each);
            return true;
        } else if constexpr (is_optional<T>) {
            (*this)(value.has_value());
            return !value || (*this)(*value);
        } else {
            return detail::archive_fields(*this, value);
        }
    }
};

struct ArchiveReader {
    std::string_view bytes;

    template <class T>
    bool operator()(T& value) {
        if constexpr (std::is_same_v<T, bool>) {
            if (bytes.empty() || (bytes.front() != '\0' && bytes.front() != '\1')) return false;
            value = bytes.front() == '\1';
            bytes.remove_prefix(1);
            return true;
        } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
            if (bytes.size() < sizeof value) return false;
            std::memcpy(&value, bytes.data(), sizeof value);
            bytes.remove_prefix(sizeof value);
            return true;
        } else if constexpr (std::is_same_v<T, std::string>) {
            std::uint64_t size = 0;
            if (!(*this)(size) || size > bytes.size()) return false;
            value.assign(bytes.substr(0, static_cast<std::size_t>(size)));
            bytes.remove_prefix(static_cast<std::size_t>(size));
            return true;
        } else if constexpr (is_list<T>) {
            std::uint64_t size = 0;
            if (!(*this)(size) || size > bytes.size()) return false;  // each element takes at least a byte
            value.clear();
            for (; size > 0; --size) {
                if (!(*this)(value.emplace_back())) return false;
            }
            return true;
        } else if constexpr (is_optional<T>) {
            bool has_value = false;
            if (!(*this)(has_value)) return false;
            value.reset();
            return !has_value || (*this)(value.emplace());
        } else {
            return detail::archive_fields(*this, value);
        }
    }
};

}  // namespace nezumi
