// The small blocks of one Lua state in one piece of memory: no header stands before a block, and what a script needs in
// a tick lies close together.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace nezumi {

/// Blocks of up to 2 KB from a region that is made with the first of them. A freed block serves again for one of its
/// size, the latest first, or in parts for smaller ones. Pages of the region that no block has reached yet cost no
/// memory. Whoever frees a block has to know its size, as Lua does.
class BlockPool {
public:
    static constexpr std::size_t region_size = std::size_t{32} << 10;  ///< [bytes]
    static constexpr std::size_t largest = 2048;                       ///< [bytes] of a block

    /// nullptr when it has none, and none can be made.
    void* take(std::size_t bytes);
    bool owns(const void* block) const {
        return region_ != nullptr &&
               static_cast<std::size_t>(static_cast<const char*>(block) - region_.get()) < region_size;
    }
    /// Takes back a block of its own that was taken with so many bytes.
    void give_back(void* block, std::size_t bytes) {
        put(static_cast<std::size_t>(static_cast<char*>(block) - region_.get()) / unit, units_of(bytes));
    }
    /// Whether a block of so many bytes can have as many as this and stay where it is.
    static bool fits_in_place(std::size_t bytes, std::size_t wanted) {
        return wanted <= largest && units_of(bytes) == units_of(wanted);
    }

    /// [bytes] of the region that blocks have reached.
    std::size_t used() const { return used_ * unit; }
    /// Leaves all blocks as they are, for ever, and begins anew.
    void abandon();

private:
    // Blocks are counted in units, and those that are free listed by their size: each begins with the place of the
    // next.
    static constexpr std::size_t unit = 16;  // [bytes]
    static constexpr std::size_t sizes = largest / unit;
    static constexpr std::uint16_t none = 0xffff;

    struct Free {
        void operator()(char* region) const;
    };

    static std::size_t units_of(std::size_t bytes) { return (bytes + unit - 1) / unit; }
    std::size_t first_free(std::size_t units) const;
    std::uint16_t& next(std::size_t place) { return *reinterpret_cast<std::uint16_t*>(region_.get() + place * unit); }
    std::size_t pop(std::size_t units);
    void put(std::size_t place, std::size_t units);

    std::unique_ptr<char, Free> region_;
    std::size_t used_ = 0;                             // units
    std::array<std::uint64_t, sizes / 64> is_free_{};  // a bit for each size that has a free block
    std::array<std::uint16_t, sizes> free_{};          // the first of each size, where there is one
};

}  // namespace nezumi
