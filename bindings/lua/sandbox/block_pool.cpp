// Lists of free blocks by size, and a mark up to which the region is used.
#include "bindings/lua/sandbox/block_pool.hpp"

#include <bit>
#include <cstdlib>

namespace nezumi {

void BlockPool::Free::operator()(char* region) const { std::free(region); }

// The least size with a free block that holds so many units; 0: there is none.
std::size_t BlockPool::first_free(std::size_t units) const {
    std::size_t word = (units - 1) / 64;
    std::uint64_t bits = is_free_[word] & (~std::uint64_t{0} << ((units - 1) % 64));
    while (bits == 0 && ++word < is_free_.size()) bits = is_free_[word];
    return bits != 0 ? word * 64 + static_cast<std::size_t>(std::countr_zero(bits)) + 1 : 0;
}

std::size_t BlockPool::pop(std::size_t units) {
    const std::size_t index = units - 1, place = free_[index];
    free_[index] = next(place);
    if (free_[index] == none) is_free_[index / 64] &= ~(std::uint64_t{1} << (index % 64));
    return place;
}

void BlockPool::put(std::size_t place, std::size_t units) {
    const std::size_t index = units - 1;
    const std::uint64_t bit = std::uint64_t{1} << (index % 64);
    next(place) = (is_free_[index / 64] & bit) != 0 ? free_[index] : none;
    free_[index] = static_cast<std::uint16_t>(place);
    is_free_[index / 64] |= bit;
}

void* BlockPool::take(std::size_t bytes) {
    if (bytes == 0 || bytes > largest) return nullptr;
    const std::size_t units = units_of(bytes);
    if (const std::size_t found = first_free(units)) {
        const std::size_t place = pop(found);
        if (found > units) put(place + units, found - units);
        return region_.get() + place * unit;
    }
    if (region_ == nullptr) region_.reset(static_cast<char*>(std::malloc(region_size)));
    if (region_ == nullptr || (used_ + units) * unit > region_size) return nullptr;
    used_ += units;
    return region_.get() + (used_ - units) * unit;
}

void BlockPool::abandon() {
    static_cast<void>(region_.release());
    used_ = 0;
    is_free_ = {};
}

}  // namespace nezumi
