// The arrays that a learning program and the processes with its worlds share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "bindings/learning/environment_file.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

/// An array in the shared memory, with one row for each world.
struct ArrayPlace {
    std::string_view name;
    std::string_view type;    ///< the type in NumPy, as in "f4"
    std::size_t offset;       ///< [bytes], a multiple of 64
    std::size_t row;          ///< [bytes] of a world
    std::size_t columns = 0;  ///< 0: one number for each world, so the array has one dimension
};

class SharedArrays {
public:
    /// Maps the memory of this descriptor, after setting its size for this number of worlds.
    static Expected<SharedArrays> map(int descriptor, const EnvironmentSpec& spec, std::size_t worlds);
    SharedArrays(SharedArrays&& other) noexcept;
    SharedArrays& operator=(SharedArrays&&) = delete;
    ~SharedArrays();

    const std::vector<ArrayPlace>& places() const { return places_; }
    std::size_t size() const { return size_; }
    std::size_t worlds() const { return worlds_; }

    std::span<float> action(std::size_t world) const { return row<float>(0, world); }
    std::span<float> observation(std::size_t world) const { return row<float>(1, world); }
    double& reward(std::size_t world) const { return row<double>(2, world).front(); }
    std::uint8_t& terminated(std::size_t world) const { return row<std::uint8_t>(3, world).front(); }
    std::uint8_t& truncated(std::size_t world) const { return row<std::uint8_t>(4, world).front(); }
    /// The seed of the present episode.
    std::uint64_t& seed(std::size_t world) const { return row<std::uint64_t>(5, world).front(); }

private:
    SharedArrays(const EnvironmentSpec& spec, std::size_t worlds);
    template <class T>
    std::span<T> row(std::size_t place, std::size_t world) const {
        const ArrayPlace& at = places_[place];
        return {reinterpret_cast<T*>(memory_ + at.offset + world * at.row), at.row / sizeof(T)};
    }

    std::vector<ArrayPlace> places_;
    std::size_t worlds_;
    std::size_t size_ = 0;
    std::byte* memory_ = nullptr;
};

}  // namespace nezumi
