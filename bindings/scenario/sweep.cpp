// Combinations, draws and simpler points.
#include "bindings/scenario/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>

#include "bindings/lua/sandbox/random.hpp"
#include "engine/base/list.hpp"
#include "engine/base/lua_text.hpp"
#include "engine/base/names.hpp"
#include "engine/system/system_spec.hpp"
#include "engine/values/value_text.hpp"

namespace nezumi {
namespace {

bool is_plain_word(const std::string& text) {
    return !text.empty() && text.find_first_of("[]{}=,\"'\\ ") == std::string::npos &&
           std::all_of(text.begin(), text.end(), [](unsigned char c) { return c > 0x20 && c != 0x7f; });
}

std::string text_of(const PlainData& data, const Value& value, int depth) {
    if (const auto* text = value.get_if<std::string>(); text != nullptr && is_plain_word(*text)) return *text;
    const auto* table = value.get_if<TableRef>();
    if (table == nullptr) return lua_text(value);
    if (depth > 4) return "{...}";
    std::string out = "{";
    std::int64_t next = 1;
    for (const auto& [key, element] : data.tables[table->index]) {
        if (out.size() > 1) out += ", ";
        const auto* index = key.get_if<std::int64_t>();
        if (index != nullptr && *index == next) {
            ++next;
        } else if (const auto* name = key.get_if<std::string>(); name != nullptr && is_identifier(*name)) {
            out += *name + "=";
        } else {
            out += "[" + text_of(data, key, depth + 1) + "]=";
        }
        out += text_of(data, element, depth + 1);
    }
    return out + "}";
}

// The number of steps from lo to hi.
double steps_of(const SweepRange& range) { return std::floor((range.hi - range.lo) / range.step + 1e-9); }

// The nearest number of the range.
double within(const SweepRange& range, double number) {
    if (range.step > 0) {
        const double most = steps_of(range);
        number = range.lo + std::clamp(std::round((number - range.lo) / range.step), 0.0, most) * range.step;
    }
    return std::clamp(number, range.lo, range.hi);
}

// Value `index` of a range with a step.
SweepValue value_at(const SweepRange& range, std::uint64_t index) {
    return number_value(range, within(range, range.lo + range.step * static_cast<double>(index)));
}

// The number of values of a key; infinite for a range without a step, unless it has only one number.
double count_of(const SweepKey& key) {
    const auto of_range = [](const SweepRange& range) {
        if (range.lo == range.hi) return 1.0;
        return range.step > 0 ? steps_of(range) + 1 : std::numeric_limits<double>::infinity();
    };
    return by_kind(key, of_range, [](const auto& list) { return static_cast<double>(list.size()); });
}

// Combination `index` of all; the last key changes fastest.
SweepPoint point_at(const Sweep& sweep, std::uint64_t index) {
    SweepPoint point(sweep.keys.size());
    for (std::size_t i = sweep.keys.size(); i-- > 0;) {
        const SweepKey& key = sweep.keys[i];
        const auto count = static_cast<std::uint64_t>(count_of(key));
        const std::uint64_t at = index % count;
        index /= count;
        point[i] = {key.name, by_kind(
                                  key, [&](const SweepRange& range) { return value_at(range, at); },
                                  [&](const auto& list) { return list[static_cast<std::size_t>(at)]; })};
    }
    return point;
}

// A number at this share of a range, with so few digits that names stay short: steps of at most a 10 000th of the
// range, or finer if there are many samples, so that few are equal.
double short_number(const SweepRange& range, double share, std::size_t samples = 0) {
    const double width = range.hi - range.lo;
    const double number = range.lo + width * share;
    if (!(width > 0) || !std::isfinite(width)) return range.lo;
    const double many = samples > 100 ? std::ceil(std::log10(static_cast<double>(samples) / 100)) : 0;
    const double digits = 4 + many - std::ceil(std::log10(width));
    if (std::abs(digits) > 300) return number;
    // Division by a power of ten gives the double that is nearest to the decimal number.
    const double scale = std::pow(10.0, std::abs(digits));
    const double rounded = digits >= 0 ? std::round(number * scale) / scale : std::round(number / scale) * scale;
    return std::clamp(std::isfinite(rounded) ? rounded : number, range.lo, range.hi);
}

SweepValue draw_value(const SweepRange& range, Random& random, std::size_t samples) {
    if (range.step > 0) return value_at(range, random.next_up_to(static_cast<std::uint64_t>(steps_of(range))));
    return number_value(range, short_number(range, random.next_fraction(), samples));
}

// Simpler numbers to try, the simplest first.
std::vector<double> simpler_numbers(const SweepRange& range, double number) {
    const double target = within(range, 0.0);
    std::vector<double> all{target};
    for (const double digits : {1.0, 10.0, 100.0, 1000.0}) {
        all.push_back(within(range, std::trunc(number * digits) / digits));
        all.push_back(within(range, std::round(number * digits) / digits));
    }
    for (const double share : {0.5, 0.75, 0.875}) {
        const double between = target + (number - target) * share;
        all.push_back(within(range, std::trunc(between)));
        all.push_back(within(range, between));
    }
    all.push_back(within(range, number > target ? number - 1 : number + 1));
    // Simpler means nearer to the target or shorter; otherwise simplifying might never end.
    const auto length = [](double value) { return fmt::format("{}", value).size(); };
    std::vector<double> out;
    for (const double candidate : all) {
        const bool nearer = std::abs(candidate - target) < std::abs(number - target);
        const bool no_longer = length(candidate) <= length(number);
        const bool shorter = length(candidate) < length(number);
        if (candidate == number || !((nearer && no_longer) || shorter)) continue;
        add_once(out, candidate);
    }
    return out;
}

const SweepValue* find_value(const std::vector<SweepValue>& values, std::string_view text) {
    const auto found = std::find_if(values.begin(), values.end(), [&](const auto& v) { return v.text == text; });
    return found == values.end() ? nullptr : &*found;
}

// Finds the point from key `at` on, by comparing with the texts that the sweep itself would write, so no parser is
// needed.
bool find_from(const Sweep& sweep, std::size_t at, std::string_view text, SweepPoint& point) {
    if (at == sweep.keys.size()) return text.empty();
    const SweepKey& key = sweep.keys[at];
    const std::string prefix = (at > 0 ? ", " : "") + key.name + "=";
    if (!text.starts_with(prefix)) return false;
    text.remove_prefix(prefix.size());
    if (const auto* range = std::get_if<SweepRange>(&key.values)) {
        double number = 0;
        const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (problem != std::errc{} || !(number >= range->lo && number <= range->hi)) return false;
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
        point.emplace_back(key.name, number_value(*range, number));
        return find_from(sweep, at + 1, text, point);
    }
    for (const SweepValue& value : std::get<std::vector<SweepValue>>(key.values)) {
        if (!text.starts_with(value.text)) continue;
        point.emplace_back(key.name, value);
        if (find_from(sweep, at + 1, text.substr(value.text.size()), point)) return true;
        point.pop_back();
    }
    return false;
}

// The end of the value of `s:any` at the start of a text: where ", name.field=" follows, or the text ends.
std::size_t end_of_value(std::string_view text) {
    for (std::size_t comma = text.find(", "); comma != text.npos; comma = text.find(", ", comma + 1)) {
        const std::string_view rest = text.substr(comma + 2);
        const std::string_view name = rest.substr(0, std::min(rest.find('='), rest.size()));
        const std::size_t dot = name.find('.');
        if (name.size() < rest.size() && dot != name.npos && is_identifier(std::string(name.substr(0, dot))) &&
            is_identifier(std::string(name.substr(dot + 1))))
            return comma;
    }
    return text.size();
}

}  // namespace

SweepValue number_value(const SweepRange& range, double number) {
    PlainData data;
    if (range.whole) {
        data.values.emplace_back(static_cast<std::int64_t>(std::llround(number)));
    } else {
        data.values.emplace_back(number);
    }
    return to_sweep_value(std::move(data));
}

double number_in(const SweepValue& value) {
    const Value& held = value.data.values.front();
    return held.is<std::int64_t>() ? static_cast<double>(held.get<std::int64_t>()) : held.get<double>();
}

SweepValue text_value(std::string text) {
    PlainData data;
    data.values.emplace_back(text);
    return {std::move(data), std::move(text)};
}

SweepPoint point_in(const Sweep& sweep, const std::vector<double>& shares) {
    SweepPoint point;
    for (std::size_t i = 0; i < sweep.keys.size(); ++i) {
        const double share = i < shares.size() ? std::clamp(shares[i], 0.0, 1.0) : 0.5;
        const auto in_range = [&](const SweepRange& range) {
            return number_value(range, range.step > 0 ? within(range, range.lo + (range.hi - range.lo) * share)
                                                      : short_number(range, share));
        };
        const auto in_list = [&](const std::vector<SweepValue>& list) {
            const auto at = static_cast<std::size_t>(share * static_cast<double>(list.size()));
            return list[std::min(at, list.size() - 1)];
        };
        point.emplace_back(sweep.keys[i].name, by_kind(sweep.keys[i], in_range, in_list));
    }
    return point;
}

std::vector<double> shares_of(const Sweep& sweep, const SweepPoint& point) {
    constexpr double middle = 0.5;
    std::vector<double> shares;
    for (const SweepKey& key : sweep.keys) {
        const SweepValue* const value = value_of(point, key.name);
        const auto of_range = [&](const SweepRange& range) {
            const double width = range.hi - range.lo;
            return width > 0 ? (number_in(*value) - range.lo) / width : middle;
        };
        const auto of_list = [&](const std::vector<SweepValue>& list) {
            const SweepValue* const found = find_value(list, value->text);
            if (found == nullptr) return middle;
            return (static_cast<double>(found - list.data()) + middle) / static_cast<double>(list.size());
        };
        shares.push_back(value != nullptr ? by_kind(key, of_range, of_list) : middle);
    }
    return shares;
}

const SweepValue* value_of(const SweepPoint& point, std::string_view key) {
    const auto found = std::find_if(point.begin(), point.end(), [&](const auto& value) { return value.first == key; });
    return found != point.end() ? &found->second : nullptr;
}

std::optional<SweepPoint> find_drawn_point(const Sweep& sweep, std::string_view text) {
    if (!text.starts_with('[') || !text.ends_with(']')) return std::nullopt;
    text = text.substr(1, text.size() - 2);
    // Values of the sweep are before those of `s:any`.
    for (std::size_t end = 0;; end += 2) {
        const std::size_t next = end == 0 && sweep.keys.empty() ? 0 : end + end_of_value(text.substr(end));
        SweepPoint point;
        if (find_from(sweep, 0, text.substr(0, next), point)) {
            std::string_view rest = text.substr(next);
            while (!rest.empty()) {
                if (rest.starts_with(", ")) rest.remove_prefix(2);
                const std::size_t equals = rest.find('=');
                if (equals == rest.npos || rest.substr(0, equals).find('.') == rest.npos) return std::nullopt;
                const std::string_view value = rest.substr(equals + 1, end_of_value(rest.substr(equals + 1)));
                point.emplace_back(rest.substr(0, equals), text_value(std::string(value)));
                rest.remove_prefix(equals + 1 + value.size());
            }
            return point;
        }
        if (next >= text.size()) return std::nullopt;
        end = next;
    }
}

SweepValue to_sweep_value(PlainData data) {
    std::string text = text_of(data, data.values.front(), 0);
    return {std::move(data), std::move(text)};
}

std::string plain_text(const SweepValue& value) {
    return value.text.starts_with('"') ? lua_unquoted(value.text) : value.text;
}

std::string text_of(const SweepPoint& point) {
    if (point.empty()) return "";
    std::string out = "[";
    for (const auto& [name, value] : point) {
        if (out.size() > 1) out += ", ";
        out += name + "=" + value.text;
    }
    return out + "]";
}

SweepPoint without(const SweepPoint& point, std::string_view key) {
    SweepPoint rest = point;
    std::erase_if(rest, [&](const auto& value) { return value.first == key; });
    return rest;
}

std::vector<SweepPoint> combinations(const Sweep& sweep) {
    std::vector<SweepPoint> all{{}};
    for (const SweepKey& key : sweep.keys) {
        const auto& values = std::get<std::vector<SweepValue>>(key.values);
        std::vector<SweepPoint> next;
        next.reserve(all.size() * values.size());
        for (const SweepPoint& point : all) {
            for (const SweepValue& value : values) {
                next.push_back(point);
                next.back().emplace_back(key.name, value);
            }
        }
        all = std::move(next);
    }
    return all;
}

SweepPoint draw_point(const Sweep& sweep, std::uint64_t seed, std::size_t index) {
    Random random(seed, index + 1);
    SweepPoint point;
    for (const SweepKey& key : sweep.keys) {
        point.emplace_back(key.name,
                           by_kind(
                               key, [&](const SweepRange& range) { return draw_value(range, random, sweep.samples); },
                               [&](const std::vector<SweepValue>& list) {
                                   return list[static_cast<std::size_t>(random.next_up_to(list.size() - 1))];
                               }));
    }
    return point;
}

std::vector<SweepPoint> draws(const Sweep& sweep, std::uint64_t seed) {
    constexpr double countable = 1e15;  // a double can hold every whole number up to here
    double all = 1;
    for (const SweepKey& key : sweep.keys) all *= count_of(key);
    std::vector<SweepPoint> points;
    if (!(all <= countable)) {
        std::set<std::string> names;
        for (std::size_t i = 0; i < sweep.samples; ++i) {
            SweepPoint point = draw_point(sweep, seed, i);
            // Rounded numbers may be equal to those of another sample.
            constexpr std::size_t most_tries = 100;
            for (std::size_t again = 1; again < most_tries && !names.insert(text_of(point)).second; ++again)
                point = draw_point(sweep, seed, i + again * sweep.samples);
            points.push_back(std::move(point));
        }
        return points;
    }
    const auto count = static_cast<std::uint64_t>(all);
    if (count <= sweep.samples) {
        for (std::uint64_t i = 0; i < count; ++i) points.push_back(point_at(sweep, i));
        return points;
    }
    // Floyd's algorithm: all sets of this size have the same probability.
    Random random(seed, 0);
    std::set<std::uint64_t> drawn;
    for (std::uint64_t last = count - sweep.samples; last < count; ++last) {
        const std::uint64_t index = random.next_up_to(last);
        const std::uint64_t next = drawn.contains(index) ? last : index;
        drawn.insert(next);
        points.push_back(point_at(sweep, next));
    }
    return points;
}

std::optional<SweepPoint> find_point(const Sweep& sweep, std::string_view text) {
    SweepPoint point;
    if (text.empty()) return sweep.keys.empty() ? std::optional(point) : std::nullopt;
    if (!text.starts_with('[') || !text.ends_with(']')) return std::nullopt;
    if (!find_from(sweep, 0, text.substr(1, text.size() - 2), point)) return std::nullopt;
    return point;
}

std::vector<SweepPoint> simpler(const Sweep& sweep, const SweepPoint& point) {
    std::vector<SweepPoint> all;
    for (const SweepKey& key : sweep.keys) {
        const SweepValue* const present = value_of(point, key.name);
        if (present == nullptr) continue;
        const auto add = [&](const SweepValue& value) {
            all.push_back(point);
            for (auto& [name, changed] : all.back()) {
                if (name == key.name) changed = value;
            }
        };
        const auto of_range = [&](const SweepRange& range) {
            for (const double number : simpler_numbers(range, number_in(*present))) add(number_value(range, number));
        };
        const auto of_list = [&](const std::vector<SweepValue>& list) {
            const SweepValue* const found = find_value(list, present->text);
            for (const SweepValue* value = list.data(); value != found; ++value) add(*value);
        };
        by_kind(key, of_range, of_list);
    }
    return all;
}

}  // namespace nezumi
