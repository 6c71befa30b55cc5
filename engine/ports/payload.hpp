// Walks over payloads: their leaves as numbers and texts, whether they are finite, and a hash of them.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "engine/ports/messages.hpp"

namespace nezumi {

namespace detail {
template <class T>
struct IsSequence : std::false_type {};
template <class T>
struct IsSequence<std::vector<T>> : std::bool_constant<!std::is_same_v<T, std::uint8_t>> {};
}  // namespace detail

/// A sequence of elements (`Octets` counts as one value).
template <class T>
concept Sequence = detail::IsSequence<T>::value;

/// Where a leaf is in a value: a chain of fields and elements, made into text only when somebody asks. Each refers to
/// the one before it, which must live as long.
class LeafPath {
public:
    LeafPath() = default;
    LeafPath field(std::string_view name) const { return {this, name, 0}; }
    /// `index`: from 1.
    LeafPath element(std::size_t index) const { return {this, {}, index}; }

    /// "position.x", "ranges[2]", "" for a single value.
    std::string text() const;

private:
    LeafPath(const LeafPath* parent, std::string_view name, std::size_t index)
        : parent_(parent), name_(name), index_(index) {}

    const LeafPath* parent_ = nullptr;
    std::string_view name_;
    std::size_t index_ = 0;
};

/// Calls `visit(path, leaf)` for every number, truth value, text and `Octets` in a payload, in order.
template <class T, class Visit>
void for_each_leaf(const T& value, Visit&& visit, const LeafPath& path = {}) {
    if constexpr (Described<T>) {
        for_each_field(value, [&](const auto& field, const auto& member) {
            for_each_leaf(member, visit, path.field(field.name));
        });
    } else if constexpr (Sequence<T>) {
        for (std::size_t i = 0; i < value.size(); ++i)
            for_each_leaf(static_cast<typename T::value_type>(value[i]), visit, path.element(i + 1));
    } else {
        visit(path, value);
    }
}

/// A leaf whose type is only known at run time. Texts are valid as long as what holds them.
using Leaf = std::variant<bool, std::int64_t, float, double, std::string_view>;
using LeafVisitor = std::function<void(const LeafPath& path, const Leaf& leaf)>;

/// The same as `for_each_leaf`, without `Octets`: what can stand in a table.
template <class T>
void visit_leaves(const T& value, const LeafVisitor& visit, const LeafPath& path = {}) {
    for_each_leaf(
        value,
        [&](const LeafPath& at, const auto& leaf) {
            using Type = std::remove_cvref_t<decltype(leaf)>;
            if constexpr (std::is_same_v<Type, Octets>) {
                return;
            } else if constexpr (std::is_integral_v<Type> && !std::is_same_v<Type, bool>) {
                visit(at, static_cast<std::int64_t>(leaf));
            } else {
                visit(at, leaf);
            }
        },
        path);
}

/// Whether every number in a payload is finite.
template <class T>
bool is_finite(const T& value) {
    if constexpr (Described<T>) {
        bool finite = true;
        for_each_field(value, [&](const auto&, const auto& member) { finite = finite && is_finite(member); });
        return finite;
    } else if constexpr (Sequence<T>) {
        if constexpr (std::is_integral_v<typename T::value_type> ||
                      std::is_same_v<typename T::value_type, std::string>) {
            return true;
        } else {
            for (const auto& element : value) {
                if (!is_finite(element)) return false;
            }
            return true;
        }
    } else if constexpr (std::is_floating_point_v<T>) {
        return std::isfinite(value);
    } else {
        return true;
    }
}

/// Bytes that a payload holds beside itself: of its texts and sequences.
template <class T>
std::size_t heap_bytes(const T& value) {
    std::size_t bytes = 0;
    if constexpr (Described<T>) {
        for_each_field(value, [&](const auto&, const auto& member) { bytes += heap_bytes(member); });
    } else if constexpr (std::is_same_v<T, std::vector<std::string>>) {
        for (const std::string& text : value) bytes += sizeof(std::string) + text.size();
    } else if constexpr (Sequence<T> || std::is_same_v<T, Octets>) {
        bytes = value.size() * sizeof(typename T::value_type);
    } else if constexpr (std::is_same_v<T, std::string>) {
        bytes = value.size();
    }
    return bytes;
}

/// One step of a 64-bit hash: multiply and fold (after the mixing function of splitmix64, Steele et al. 2014).
constexpr std::uint64_t mix(std::uint64_t seed, std::uint64_t value) {
    std::uint64_t h = (seed ^ value) * 0x9e3779b97f4a7c15ULL;
    h ^= h >> 32;
    h *= 0xbf58476d1ce4e5b9ULL;
    return h ^ (h >> 29);
}

/// Mixes a text or bytes into a hash.
std::uint64_t mix(std::uint64_t seed, std::string_view bytes);

/// Mixes a payload into a hash; equal payloads mix equally, and -0.0 as 0.0.
template <class T>
std::uint64_t mix_payload(std::uint64_t seed, const T& value) {
    if constexpr (Described<T>) {
        for_each_field(value, [&](const auto&, const auto& member) { seed = mix_payload(seed, member); });
        return seed;
    } else if constexpr (std::is_same_v<T, Octets>) {
        return mix(seed, std::string_view(reinterpret_cast<const char*>(value.data()), value.size()));
    } else if constexpr (Sequence<T>) {
        seed = mix(seed, value.size());
        for (const auto& element : value) seed = mix_payload<typename T::value_type>(seed, element);
        return seed;
    } else if constexpr (std::is_same_v<T, std::string>) {
        return mix(seed, std::string_view(value));
    } else if constexpr (std::is_floating_point_v<T>) {
        return mix(seed, std::bit_cast<std::uint64_t>(static_cast<double>(value) + 0.0));
    } else {
        return mix(seed, static_cast<std::uint64_t>(value));
    }
}

/// Whether every number in a payload of any type is finite.
bool is_finite(const AnyPayload& value);

}  // namespace nezumi
