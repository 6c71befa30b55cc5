// The random numbers of `math.random`: xoshiro256**, the same on every machine.
#pragma once

#include <bit>
#include <cstdint>

namespace nezumi {

/// xoshiro256** 1.0 by D. Blackman and S. Vigna (https://prng.di.unimi.it), seeded with splitmix64.
class Random {
public:
    explicit constexpr Random(std::uint64_t seed = 0, std::uint64_t more = 0) {
        std::uint64_t mix = seed ^ std::rotl(more, 32);
        for (std::uint64_t& word : words_) {
            mix += 0x9e3779b97f4a7c15u;
            std::uint64_t z = mix;
            z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
            z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
            word = z ^ (z >> 31);
        }
    }

    /// 64 random bits.
    constexpr std::uint64_t next() {
        const std::uint64_t result = std::rotl(words_[1] * 5, 7) * 9;
        const std::uint64_t shifted = words_[1] << 17;
        words_[2] ^= words_[0];
        words_[3] ^= words_[1];
        words_[1] ^= words_[2];
        words_[0] ^= words_[3];
        words_[2] ^= shifted;
        words_[3] = std::rotl(words_[3], 45);
        return result;
    }

    /// Uniform in [0, 1), with 53 random bits.
    constexpr double next_fraction() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

    /// Uniform in [0, limit], including the limit.
    constexpr std::uint64_t next_up_to(std::uint64_t limit) {
        if (limit == 0) return 0;
        const int unused_bits = std::countl_zero(limit);
        for (;;) {  // at most half of the draws are rejected
            const std::uint64_t draw = next() >> unused_bits;
            if (draw <= limit) return draw;
        }
    }

private:
    std::uint64_t words_[4]{};
};

}  // namespace nezumi
