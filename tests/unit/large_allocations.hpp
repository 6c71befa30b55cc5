// Counts large pieces of memory that a thread takes with `new`, for tests that nothing large is copied. For one file of
// a program: it replaces the program's operators. None is counted under the thread sanitizer, which has operators of
// its own that can't be replaced.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>

#include "engine/base/sanitizers.hpp"

namespace nezumi {

inline constexpr std::size_t large_allocation = 50'000;  // [bytes]

/// By the calling thread so far.
inline std::size_t& large_allocations() {
    thread_local std::size_t count = 0;
    return count;
}

}  // namespace nezumi

#ifndef NEZUMI_THREAD_SANITIZER
void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
    if (size >= nezumi::large_allocation) ++nezumi::large_allocations();
    return std::malloc(size > 0 ? size : 1);
}
void* operator new(std::size_t size) {
    if (void* const memory = operator new(size, std::nothrow)) return memory;
    throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
#endif
