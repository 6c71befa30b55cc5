// Walks over values of any type: their leaves as numbers and texts, whether they are finite, what memory they take, and
// a hash of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "engine/values/view.hpp"

namespace nezumi {

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

/// Takes a number, a truth value or a text.
using LeafVisitor = std::function<void(const LeafPath& path, const ValueView& leaf)>;

/// Calls `visit(path, leaf)` for every number, truth value and text in a value, in order: what can stand in a table.
/// `Octets` can't.
void visit_leaves(const ValueView& value, const LeafVisitor& visit, const LeafPath& path = {});

/// Whether two values are the same: of one type, with the same elements and equal numbers, texts and bytes.
bool is_equal(const ValueView& a, const ValueView& b);

/// Whether every number in a value is finite, but for fields in which others mean something (`Numbers::any`).
bool is_finite(const ValueView& value);

/// Bytes of all texts in a value.
std::size_t text_bytes(const ValueView& value);

/// Bytes that a value holds beside itself: of its texts and sequences.
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

/// Mixes a value into a hash; equal values mix equally, and -0.0 as 0.0.
std::uint64_t mix_payload(std::uint64_t seed, const ValueView& value);

}  // namespace nezumi
