// The values that a scenario is run with: all combinations of listed values, or random draws from ranges.
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

/// One value of a sweep: plain data of Lua, and its text in the name of a run.
struct SweepValue {
    PlainData data;    ///< one value
    std::string text;  ///< "0.1", "true", "fast", "{x=1, y=2}"

    bool operator==(const SweepValue& other) const { return data == other.data; }
};

/// A sweep value from plain data that holds one value.
SweepValue to_sweep_value(PlainData data);

/// A value of which only the text is known.
SweepValue text_value(std::string text);

/// The text of a value in a table: a Lua string without quotes and escapes.
std::string plain_text(const SweepValue& value);

/// `range(lo, hi)` or `range(lo, hi, step)`.
struct SweepRange {
    double lo = 0;
    double hi = 1;
    double step = 0;     ///< 0: any number between; otherwise lo, lo + step, ... up to hi
    bool whole = false;  ///< the values are integers, because lo and step are

    bool operator==(const SweepRange&) const = default;
};

/// The number of a value of a range.
double number_in(const SweepValue& value);

/// The nearest value of a range.
SweepValue number_value(const SweepRange& range, double number);

struct SweepKey {
    std::string name;
    std::variant<std::vector<SweepValue>, SweepRange> values;
};

/// Calls the function for the kind of values that a key has.
template <class OfRange, class OfList>
auto by_kind(const SweepKey& key, const OfRange& of_range, const OfList& of_list) {
    const auto* range = std::get_if<SweepRange>(&key.values);
    return range != nullptr ? of_range(*range) : of_list(std::get<std::vector<SweepValue>>(key.values));
}

/// Keys in ascending order.
struct Sweep {
    std::vector<SweepKey> keys;
    /// Number of random draws; 0: all combinations of listed values. A sweep with a range is always drawn.
    std::size_t samples = 0;

    bool is_random() const { return samples > 0; }
};

/// The values of one run, in the order of the sweep's keys.
using SweepPoint = std::vector<std::pair<std::string, SweepValue>>;

/// The largest number of runs of a sweep.
inline constexpr std::size_t most_runs = 100'000;

/// "[speed=0.1, stop_d=30]"; "" for a point without values.
std::string text_of(const SweepPoint& point);

/// The value of a key; null if the point has none.
const SweepValue* value_of(const SweepPoint& point, std::string_view key);

/// The values of a point without the value of one key.
SweepPoint without(const SweepPoint& point, std::string_view key);

/// All combinations of listed values; the last key changes fastest. One point without values if there are no keys.
std::vector<SweepPoint> combinations(const Sweep& sweep);

/// Draws sample `index`; `seed` is the seed of the scenario. Each sample is independent of the others.
SweepPoint draw_point(const Sweep& sweep, std::uint64_t seed, std::size_t index);

/// The points of a random sweep. If all its values can be counted (lists, ranges with a step or of one number), no
/// point comes twice: all points in the order of `combinations` if there are at most as many as samples, otherwise a
/// random choice. If not, each sample is drawn independently, again if it is equal to an earlier one.
std::vector<SweepPoint> draws(const Sweep& sweep, std::uint64_t seed);

/// The point at a place in the unit cube: a share from 0 to 1 of each range, and of each list.
SweepPoint point_in(const Sweep& sweep, const std::vector<double>& shares);
/// The place of a point; 0.5 for values that it lacks. Values of a list are in the middle of their parts.
std::vector<double> shares_of(const Sweep& sweep, const SweepPoint& point);

/// The point with this text: values of the sweep, then values of `s:any` such as "gust.at=3". Nothing if the sweep has
/// no such values.
std::optional<SweepPoint> find_drawn_point(const Sweep& sweep, std::string_view text);

/// The point with this text (`text_of`); nothing if the sweep has no such point. Values of ranges may be any number in
/// the range.
std::optional<SweepPoint> find_point(const Sweep& sweep, std::string_view text);

/// Simpler points to try instead of a failing one, simplest first: numbers of ranges nearer to 0 (or to the end of the
/// range next to it) and with fewer digits, and earlier values of lists.
std::vector<SweepPoint> simpler(const Sweep& sweep, const SweepPoint& point);

}  // namespace nezumi
