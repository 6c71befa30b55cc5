// Statistics of late ticks: how many were late, and by how much.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace nezumi {

/// Needs a few kB, however long the run is. Allocates nothing.
class Lateness {
public:
    /// Adds a tick that began `seconds` after it was due, with this period [s]. It counts as late if this is more than
    /// a tenth of the period.
    void add(double seconds, double period);
    /// Counts ticks that were skipped after a stall.
    void skip(std::uint64_t ticks) { skipped_ += ticks; }
    /// Adds all ticks of another object, as later ticks.
    void add(const Lateness& later);

    std::uint64_t ticks() const { return ticks_; }
    std::uint64_t late() const { return late_; }
    std::uint64_t skipped() const { return skipped_; }
    /// The lateness of the latest tick, and the largest one [s].
    double latest() const { return latest_; }
    double worst() const { return worst_; }
    /// The lateness [s] that this fraction (0 to 1) of all ticks did not exceed. The error is at most 5 % or 0.1 us;
    /// the result is at most `worst`.
    double quantile(double part) const;

private:
    // Number of classes for a factor of 2: each is 4.4 % wider than the one before.
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
