// What a scenario is tried with: every combination of listed values, or values drawn at random from ranges.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "bindings/lua/values/plain_data.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

/// One value of a sweep: plain data of Lua, and how it is written in the name of a run.
struct SweepValue {
    PlainData data;    ///< one value
    std::string text;  ///< "0.1", "true", "fast", "{x=1, y=2}"

    bool operator==(const SweepValue& other) const { return data == other.data; }
};

/// Plain data that holds one value, with its text.
SweepValue to_sweep_value(PlainData data);

/// Its text as a table has it: a text of Lua without quotes and escapes.
std::string plain_text(const SweepValue& value);

/// `range(lo, hi)` or `range(lo, hi, step)`.
struct SweepRange {
    double lo = 0;
    double hi = 1;
    double step = 0;     ///< 0: any number between; otherwise lo, lo + step, ... up to hi
    bool whole = false;  ///< the values are integers: lo and step are

    bool operator==(const SweepRange&) const = default;
};

struct SweepKey {
    std::string name;
    std::variant<std::vector<SweepValue>, SweepRange> values;
};

/// Keys in ascending order.
struct Sweep {
    std::vector<SweepKey> keys;
    /// How many random draws; 0: every combination of listed values. A sweep with a range is always drawn.
    std::size_t samples = 0;

    bool is_random() const { return samples > 0; }
};

/// The values of one run, in the order of the sweep's keys.
using SweepPoint = std::vector<std::pair<std::string, SweepValue>>;

/// How many runs a sweep may make.
inline constexpr std::size_t most_runs = 100'000;

/// "[speed=0.1, stop_d=30]"; "" for a point without values.
std::string text_of(const SweepPoint& point);

/// A point's values but for that of one key.
SweepPoint without(const SweepPoint& point, std::string_view key);

/// Every combination of listed values, the last key changing fastest. One point without values when there are no keys.
std::vector<SweepPoint> combinations(const Sweep& sweep);

/// Draws sample `index`; `seed` is that of the scenario. Each sample is independent of the others.
SweepPoint draw_point(const Sweep& sweep, std::uint64_t seed, std::size_t index);

/// The points of a random sweep. Where all its values can be counted (lists, ranges with a step or of one number), none
/// comes twice: all of them, as `combinations` would order them, when they are no more than the samples; else a draw of
/// so many. Where one can't, every sample by itself.
std::vector<SweepPoint> draws(const Sweep& sweep, std::uint64_t seed);

/// The point that `text_of` has written like this; nothing when the sweep has none such. Values of ranges may be any
/// number within.
std::optional<SweepPoint> find_point(const Sweep& sweep, std::string_view text);

/// Simpler points to try in place of one that fails, the simplest first: numbers of ranges nearer to 0 (or to the end
/// of the range next to it) and with fewer digits, earlier values of lists.
std::vector<SweepPoint> simpler(const Sweep& sweep, const SweepPoint& point);

}  // namespace nezumi
