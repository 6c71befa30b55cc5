// How ticks have kept to the clock: how many were late, and by how much.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace nezumi {

/// Counts in a few kB however long a run is. Nothing is allocated.
class Lateness {
public:
    /// A tick that began so long after it was due [s], of a period [s]. It is late by more than a tenth of that.
    void add(double seconds, double period);
    /// Ticks that were left out after a stall.
    void skip(std::uint64_t ticks) { skipped_ += ticks; }
    /// All that another one has counted, as that which came after.
    void add(const Lateness& later);

    std::uint64_t ticks() const { return ticks_; }
    std::uint64_t late() const { return late_; }
    std::uint64_t skipped() const { return skipped_; }
    /// How late the latest tick began, and the worst of all [s].
    double latest() const { return latest_; }
    double worst() const { return worst_; }
    /// That part (0 to 1) of all ticks began no later than this [s]; at most 5 % or 0.1 us more, and never more than
    /// the worst.
    double quantile(double part) const;

private:
    // A power of 2 of microseconds has so many classes: each is 4.4 % wider than the one before.
    static constexpr int classes = 16;
    static constexpr int octaves = 27;  // up to 134 s

    static std::size_t class_of(double seconds);
    static double upper_end(std::size_t number);

    std::array<std::uint64_t, classes * octaves> counts_{};
    std::uint64_t ticks_ = 0;
    std::uint64_t late_ = 0;
    std::uint64_t skipped_ = 0;
    double latest_ = 0;
    double worst_ = 0;
};

/// "p50 0.06 ms, p99 0.31 ms, worst 2.10 ms"
std::string to_text(const Lateness& lateness);

}  // namespace nezumi
