// Memory for the first small blocks of a Lua state, in one region.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

#include "engine/base/sanitizers.hpp"

namespace nezumi {

/// Most objects of Lua are small. In this region they need no header as in `malloc`, lie next to each other, and are
/// released quickly. When the region is full, which is about when a script of usual size is loaded, further blocks come
/// from elsewhere. So a script never wastes more than the region.
class SmallBlocks {
public:
    static constexpr std::size_t most = 128;  ///< [bytes] of a block
    static constexpr std::size_t region =
        8192;  ///< [bytes] measured: a smaller region gains less, a larger one is not full

    SmallBlocks() = default;
    ~SmallBlocks() { std::free(begin_); }
    SmallBlocks(const SmallBlocks&) = delete;
    SmallBlocks& operator=(const SmallBlocks&) = delete;

    /// A block of this size (1 or more), aligned for pointers; null if there is no room.
    void* take(std::size_t bytes) {
        if (bytes > most) return nullptr;
        Free*& first = free_[kind_of(bytes)];
        if (first != nullptr) {
            Free* const block = first;
            first = block->next;
            return block;
        }
        const std::size_t whole = (kind_of(bytes) + 1) * step;
        if (whole > region - used_ || !open()) return nullptr;
        void* const block = begin_ + used_;
        used_ += whole;
        return block;
    }
    bool owns(const void* block) const {
        return reinterpret_cast<std::uintptr_t>(block) - reinterpret_cast<std::uintptr_t>(begin_) < used_;
    }
    /// Releases a block of this region. `bytes` is its size, or less.
    void give_back(void* block, std::size_t bytes) {
        Free*& first = free_[kind_of(bytes)];
        first = new (block) Free{first};
    }
    /// Begins with a new region. The old one, with its blocks, stays allocated.
    void abandon() {
        begin_ = nullptr;
        used_ = 0;
        free_ = {};
    }

private:
    struct Free {
        Free* next;
    };
    static constexpr std::size_t step = sizeof(Free);
    static std::size_t kind_of(std::size_t bytes) { return (bytes - 1) / step; }

    bool open() {
#if !defined(NEZUMI_ADDRESS_SANITIZER)
        if (begin_ == nullptr) begin_ = static_cast<char*>(std::malloc(region));
#endif
        return begin_ != nullptr;
    }

    char* begin_ = nullptr;
    std::size_t used_ = 0;
    std::array<Free*, most / step> free_{};
};

}  // namespace nezumi
