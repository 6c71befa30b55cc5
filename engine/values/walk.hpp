// Functions over values of any type: visit their numbers and texts, check that they are finite, measure their memory,
// hash them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "engine/values/view.hpp"

namespace nezumi {

/// The path of a leaf in a value: a chain of fields and elements, converted to text on demand. Each part refers to the
/// part before it, which must live as long.
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

/// A function for a number, boolean or text.
using LeafVisitor = std::function<void(const LeafPath& path, const ValueView& leaf)>;

/// Calls `visit(path, leaf)` for every number, boolean and text in a value, in order: the values that can be
/// columns of a table. Excludes `Octets`.
void visit_leaves(const ValueView& value, const LeafVisitor& visit, const LeafPath& path = {});

/// Writes the leaves that `visit_leaves` visits as numbers, in order, until `numbers` is full: 0 and 1 for booleans,
/// and what `of_text` returns for texts. Returns how many were written.
std::size_t leaf_numbers(const ValueView& value, std::span<double> numbers,
                         const std::function<double(const std::string& text)>& of_text);

/// Whether two values are equal: the same type and the same elements.
bool is_equal(const ValueView& a, const ValueView& b);

/// Whether every number in a value is finite, except in fields that allow others (`Numbers::any`).
bool is_finite(const ValueView& value);

/// Total size of all texts in a value [bytes].
std::size_t text_bytes(const ValueView& value);

/// Memory of a value's texts and sequences [bytes].
std::size_t heap_bytes(const ValueView& value);

/// One step of a 64-bit hash: multiply and fold (after the mixing function of splitmix64, Steele et al. 2014).
constexpr std::uint64_t mix(std::uint64_t seed, std::uint64_t value) {
    std::uint64_t h = (seed ^ value) * 0x9e3779b97f4a7c15ULL;
    h ^= h >> 32;
    h *= 0xbf58476d1ce4e5b9ULL;
    return h ^ (h >> 29);
}

/// Mixes a text or bytes into a hash.
std::uint64_t mix(std::uint64_t seed, std::string_view bytes);

/// Mixes a value into a hash. Equal values give equal hashes; -0.0 counts as 0.0.
std::uint64_t mix_payload(std::uint64_t seed, const ValueView& value);

}  // namespace nezumi
