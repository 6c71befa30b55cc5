// Places the arrays one after the other in one mapping.
#include "bindings/learning/shared_arrays.hpp"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace nezumi {

SharedArrays::SharedArrays(const EnvironmentSpec& spec, std::size_t worlds) : worlds_(worlds) {
    constexpr std::size_t line = 64;  // [bytes] of a cache line: arrays begin at one, so that they share no line
    const auto place = [&](std::string_view name, std::string_view type, std::size_t bytes, std::size_t columns) {
        const std::size_t row = bytes * (columns == 0 ? 1 : columns);
        places_.push_back({name, type, size_, row, columns});
        size_ += (worlds * row + line - 1) / line * line;
    };
    place("actions", "f4", sizeof(float), width_of(spec.action));
    place("observations", "f4", sizeof(float), width_of(spec.observation));
    place("rewards", "f8", sizeof(double), 0);
    place("terminated", "u1", sizeof(std::uint8_t), 0);
    place("truncated", "u1", sizeof(std::uint8_t), 0);
    place("seeds", "u8", sizeof(std::uint64_t), 0);
}

Expected<SharedArrays> SharedArrays::map(int descriptor, const EnvironmentSpec& spec, std::size_t worlds) {
    SharedArrays arrays(spec, worlds);
    void* memory = MAP_FAILED;
    if (ftruncate(descriptor, static_cast<off_t>(arrays.size_)) == 0)
        memory = mmap(nullptr, arrays.size_, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
    if (memory == MAP_FAILED)
        return failure(fmt::format("--memory {}: can't be used as shared memory of {} bytes: {}", descriptor,
                                   arrays.size_, std::strerror(errno)));
    arrays.memory_ = static_cast<std::byte*>(memory);
    return arrays;
}

SharedArrays::SharedArrays(SharedArrays&& other) noexcept
    : places_(std::move(other.places_)),
      worlds_(other.worlds_),
      size_(other.size_),
      memory_(std::exchange(other.memory_, nullptr)) {}

SharedArrays::~SharedArrays() {
    if (memory_ != nullptr) munmap(memory_, size_);
}

}  // namespace nezumi
