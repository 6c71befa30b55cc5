// Several numbers that a processor handles at once, so that robots are computed in groups.
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace nezumi::sim {

/// One number for each of `Lanes::count` robots. Each operation gives the same bits as with a `double`.
struct Lanes {
    static constexpr std::size_t count = 4;
    using Vector = double __attribute__((vector_size(count * sizeof(double))));
    // Eigen aligns its members to 16 bytes at most.
    using Numbers __attribute__((aligned(16))) = Vector;

    Lanes() = default;
    // NOLINTNEXTLINE(google-explicit-constructor): a number is the same for all robots
    Lanes(double all) : numbers{all, all, all, all} {}
    explicit Lanes(const Numbers& each) : numbers(each) {}

    void set(std::size_t lane, double number) { numbers[lane] = number; }
    double operator[](std::size_t lane) const { return numbers[lane]; }

    Lanes operator-() const { return Lanes(-numbers); }
    friend Lanes operator+(Lanes a, Lanes b) { return Lanes(a.numbers + b.numbers); }
    friend Lanes operator-(Lanes a, Lanes b) { return Lanes(a.numbers - b.numbers); }
    friend Lanes operator*(Lanes a, Lanes b) { return Lanes(a.numbers * b.numbers); }
    friend Lanes operator/(Lanes a, Lanes b) { return Lanes(a.numbers / b.numbers); }
    Lanes& operator+=(Lanes other) { return *this = *this + other; }
    Lanes& operator-=(Lanes other) { return *this = *this - other; }
    Lanes& operator*=(Lanes other) { return *this = *this * other; }

    Numbers numbers;
};

/// A boolean for each lane.
struct LaneMask {
    using Vector = std::int64_t __attribute__((vector_size(Lanes::count * sizeof(std::int64_t))));
    using Bits __attribute__((aligned(16))) = Vector;

    bool operator[](std::size_t lane) const { return bits[lane] != 0; }
    Bits bits;
};

inline LaneMask operator>=(Lanes a, Lanes b) { return {a.numbers >= b.numbers}; }
inline LaneMask operator>(Lanes a, Lanes b) { return {a.numbers > b.numbers}; }
inline LaneMask operator<=(Lanes a, Lanes b) { return {a.numbers <= b.numbers}; }
inline LaneMask operator<(Lanes a, Lanes b) { return {a.numbers < b.numbers}; }

inline Lanes choose(LaneMask mask, Lanes yes, Lanes no) { return Lanes(mask.bits ? yes.numbers : no.numbers); }
inline double choose(bool mask, double yes, double no) { return mask ? yes : no; }

inline bool both(bool a, bool b) { return a && b; }
inline LaneMask both(LaneMask a, LaneMask b) { return {a.bits & b.bits}; }

inline bool any(bool mask) { return mask; }
inline bool any(LaneMask mask) {
    bool is = false;
    for (std::size_t i = 0; i < Lanes::count; ++i) is = is || mask[i];
    return is;
}

inline double largest(double x) { return x; }
inline double largest(Lanes x) {
    double most = x[0];
    for (std::size_t i = 1; i < Lanes::count; ++i) most = x[i] > most ? x[i] : most;
    return most;
}

inline double root(double x) { return std::sqrt(x); }
inline Lanes root(Lanes x) {
    Lanes roots;
    for (std::size_t i = 0; i < Lanes::count; ++i) roots.set(i, std::sqrt(x[i]));
    return roots;
}

// Equal to std::min and std::max, also for equal arguments.
template <class Real>
Real lesser(Real a, Real b) {
    return choose(b < a, b, a);
}
template <class Real>
Real greater(Real a, Real b) {
    return choose(a < b, b, a);
}
inline double magnitude(double x) { return std::abs(x); }
inline Lanes magnitude(Lanes x) {
    Lanes all;
    for (std::size_t i = 0; i < Lanes::count; ++i) all.set(i, std::abs(x[i]));
    return all;
}

}  // namespace nezumi::sim

template <>
struct Eigen::NumTraits<nezumi::sim::Lanes> : Eigen::NumTraits<double> {
    using Real = nezumi::sim::Lanes;
    using NonInteger = nezumi::sim::Lanes;
    using Nested = nezumi::sim::Lanes;
    using Literal = double;
};
