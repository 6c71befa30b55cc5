// Rounds have a fixed size that does not depend on the number of jobs. A place has a number from
// 0 to 1 for each value: where it is in the range of the value.
#include "bindings/scenario/search.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>

namespace nezumi {
namespace {

constexpr std::size_t first_round = 12;
constexpr std::size_t most_corners = 8;
// How many standard deviations below the mean of the model a point counts: 0 chooses points near the best ones, 2 also
// points where few others are.
constexpr double least_optimism = 0.0;
constexpr double exploring_optimism = 2.0;
constexpr std::size_t most_modelled = 100;  // points of a model: the nearest to failing, and the latest
constexpr std::size_t best_ones = 3;        // points are chosen near them
constexpr double widest_decades = 0.5;      // changes of a value are 10^-0.5 to 10^-3 of its range
constexpr double finest_decades = 3;
constexpr double finest_end = 10;  // distances from an end are 2^0 to 2^-10 of the range

std::vector<SweepValue> choices_of(const DrawnValue& drawn) {
    std::vector<SweepValue> values;
    for (const std::string& choice : drawn.choices) values.push_back(text_value(choice));
    return values;
}

// The number of all points; nothing if there are too many to choose all of them.
std::optional<std::size_t> size_of(const Sweep& sweep) {
    constexpr double most = 10'000;
    double size = sweep.keys.empty() ? most : 1;
    for (const SweepKey& key : sweep.keys) {
        if (const auto* const range = std::get_if<SweepRange>(&key.values)) {
            size *= range->step > 0 ? std::floor((range->hi - range->lo) / range->step + 1e-9) + 1 : most;
        } else {
            size *= static_cast<double>(std::get<std::vector<SweepValue>>(key.values).size());
        }
    }
    return size < most ? std::optional(static_cast<std::size_t>(size)) : std::nullopt;
}

// The number of random points to try, so that probably each of `size` points has been drawn.
std::size_t tries_of(const std::optional<std::size_t>& size) { return 20 * size.value_or(1); }

}  // namespace

Sweep with_drawn(Sweep sweep, const std::vector<DrawnValue>& drawn) {
    for (const DrawnValue& each : drawn) {
        const auto same = [&](const SweepKey& key) { return key.name == each.name; };
        if (std::any_of(sweep.keys.begin(), sweep.keys.end(), same)) continue;
        SweepKey key{each.name, each.range};
        if (!each.choices.empty()) key.values = choices_of(each);
        sweep.keys.push_back(std::move(key));
    }
    return sweep;
}

SweepPoint with_drawn(SweepPoint point, const std::vector<DrawnValue>& drawn) {
    for (const DrawnValue& each : drawn) {
        SweepValue value = each.choices.empty() ? number_value(each.range, each.number) : text_value(each.text);
        const auto found =
            std::find_if(point.begin(), point.end(), [&](const auto& at) { return at.first == each.name; });
        if (found == point.end()) {
            point.emplace_back(each.name, std::move(value));
        } else {
            found->second = std::move(value);  // the name of a run has given only the text of this value
        }
    }
    return point;
}

std::vector<DrawnValue> drawn_values(const Sweep& sweep, const SweepPoint& point) {
    std::vector<DrawnValue> all;
    for (const SweepKey& key : sweep.keys) {
        const SweepValue* const value = value_of(point, key.name);
        if (value == nullptr) continue;
        DrawnValue& drawn = all.emplace_back(DrawnValue{.name = key.name, .text = value->text});
        const auto of_range = [&](const SweepRange& range) {
            drawn.range = range;
            drawn.number = number_in(*value);
        };
        const auto of_list = [&](const std::vector<SweepValue>& list) {
            for (const SweepValue& choice : list) drawn.choices.push_back(choice.text);
        };
        by_kind(key, of_range, of_list);
    }
    return all;
}

SweepPoint Search::random_point() { return draw_point(sweep_, random_.next(), draws_++); }

std::vector<SweepPoint> Search::next(std::size_t most) {
    using enum Way;
    constexpr std::array ways{least_of_model, near_least, near_ends, explored_by_model, near_new_lines, random};
    std::vector<SweepPoint> points;
    if (rounds_++ == 0) {
        points = first_points(std::min(most, first_round));
    } else {
        chosen_.clear();
        for (std::size_t i = 0; i < std::min(most, ways.size()); ++i) points.push_back(point_of(ways[i]));
    }
    // Does not repeat a point: its result would be the same.
    const std::optional<std::size_t> size = size_of(sweep_);
    std::vector<SweepPoint> once;
    for (SweepPoint& point : points) {
        bool is_new = names_.insert(text_of(point)).second;
        const bool has_new = !size || names_.size() < *size;
        for (std::size_t i = 0; i < tries_of(size) && !is_new && has_new; ++i) {
            point = random_point();
            is_new = names_.insert(text_of(point)).second;
        }
        if (is_new || !size) once.push_back(std::move(point));
    }
    return once;
}

// Corners: many failures are where values are least or greatest. With more than three values, a part of the corners in
// which each pair of values has all four combinations (a fractional factorial design, Box and Hunter 1961), up to
// seven values.
std::vector<SweepPoint> Search::first_points(std::size_t count) {
    const std::size_t keys = sweep_.keys.size();
    const std::size_t corners = keys < 3 ? std::size_t{1} << keys : most_corners;
    constexpr std::array<unsigned, 7> masks{1, 2, 4, 7, 3, 5, 6};
    const std::uint64_t flips = random_.next();
    const auto first = static_cast<unsigned>(random_.next_up_to(corners - 1));
    std::vector<SweepPoint> points;
    for (unsigned i = 0; points.size() < count; ++i) {
        const bool is_random = keys == 0 || points.size() % 3 == 2 || i >= corners;
        if (is_random) points.push_back(random_point());
        if (is_random && points.size() == count) break;
        if (i >= corners || keys == 0) continue;
        Shares place(keys);
        for (std::size_t key = 0; key < keys; ++key) {
            const bool is_flipped = ((flips >> (key % 64)) & 1) != 0;
            place[key] = (std::popcount((i ^ first) & masks[key % masks.size()]) % 2 == 1) != is_flipped ? 1.0 : 0.0;
        }
        points.push_back(point_in(sweep_, place));
    }
    return points;
}

SweepPoint Search::point_of(Way way) {
    if (sweep_.keys.empty()) return random_point();
    switch (way) {
        case Way::least_of_model: return modelled_point(least_optimism);
        case Way::explored_by_model: return modelled_point(exploring_optimism);
        case Way::near_least: return near_least();
        case Way::near_ends: return near_ends();
        case Way::near_new_lines: return near_new_lines();
        case Way::random: break;
    }
    return random_point();
}

// The runs of the next condition, in turn, that has different margins in at least three runs; none if there is none.
Search::Ranked Search::next_condition() {
    std::set<std::string> conditions;
    for (const Seen& seen : seen_) {
        for (const auto& margin : seen.margins) conditions.insert(margin.first);
    }
    for (std::size_t tried = 0; tried < conditions.size(); ++tried) {
        auto condition = conditions.begin();
        std::advance(condition, static_cast<std::ptrdiff_t>(turn_++ % conditions.size()));
        Ranked known;
        for (std::size_t i = 0; i < seen_.size(); ++i) {
            const auto margin = seen_[i].margins.find(*condition);
            if (margin != seen_[i].margins.end()) known.emplace_back(margin->second, i);
        }
        std::sort(known.begin(), known.end());
        condition_ = *condition;
        if (known.size() >= 3 && known.front().first < known.back().first) return known;
    }
    return {};
}

// A point that this round has chosen before counts as seen, with a middle value, so that the next one is elsewhere.
SweepPoint Search::modelled_point(double optimism) {
    Ranked known = next_condition();
    if (known.empty()) return random_point();
    if (known.size() > most_modelled) {
        const auto middle = known.begin() + most_modelled / 2;
        std::nth_element(middle, middle + most_modelled / 2, known.end(),
                         [](const auto& a, const auto& b) { return a.second > b.second; });
        known.resize(most_modelled);
    }
    std::vector<Shares> places;
    std::vector<double> values;
    for (const auto& [value, index] : known) {
        places.push_back(seen_[index].place);
        values.push_back(value);
    }
    for (const auto& [place, condition] : chosen_) {
        if (condition != condition_) continue;
        places.push_back(place);
        values.push_back(values[values.size() / 2]);
    }
    std::vector<bool> is_choice;
    for (const SweepKey& key : sweep_.keys) is_choice.push_back(!std::holds_alternative<SweepRange>(key.values));
    const MarginModel model(std::move(places), values, std::move(is_choice));
    SweepPoint point = point_in(sweep_, model.least_place(optimism));
    chosen_.emplace_back(shares_of(sweep_, point), condition_);
    return point;
}

// Near one of the least margins: where the model is too coarse, small changes show where they shrink.
SweepPoint Search::near_least() {
    const Ranked known = next_condition();
    if (known.empty()) return random_point();
    return near(seen_[known[random_.next_up_to(std::min(best_ones, known.size()) - 1)].second].place);
}

SweepPoint Search::near_new_lines() {
    if (had_new_lines_.empty()) return near_least();
    // Chooses one of the latest runs, because the lines of earlier ones have run more often.
    const std::size_t back = random_.next_up_to(std::min(best_ones, had_new_lines_.size()) - 1);
    return near(had_new_lines_[had_new_lines_.size() - 1 - back]);
}

// One or all values are changed a little; how little differs by orders of magnitude.
SweepPoint Search::near(Shares place) {
    const std::uint64_t only = random_.next_up_to(place.size());
    const double size = std::pow(10, -widest_decades - (finest_decades - widest_decades) * random_.next_fraction());
    for (std::size_t i = 0; i < place.size(); ++i) {
        if (only != place.size() && only != i) continue;
        const bool is_choice = !std::holds_alternative<SweepRange>(sweep_.keys[i].values);
        place[i] = is_choice ? random_.next_fraction() : std::clamp(place[i] + size * next_signed(), 0.0, 1.0);
    }
    return point_in(sweep_, place);
}

// Some values are near an end of their range, or near 0, how near differs by orders of magnitude. The others are those
// of a run with a small margin, or random.
SweepPoint Search::near_ends() {
    const Ranked known = random_.next_up_to(1) == 0 ? next_condition() : Ranked();
    Shares place = known.empty() ? shares_of(sweep_, random_point())
                                 : seen_[known[random_.next_up_to(std::min(best_ones, known.size()) - 1)].second].place;
    const std::uint64_t always = random_.next_up_to(place.size() - 1);
    for (std::size_t i = 0; i < place.size(); ++i) {
        if (i != always && random_.next_up_to(1) == 0) continue;
        const double distance = std::pow(2, -finest_end * random_.next_fraction());
        std::vector<double> ends{0, 1};
        const auto* const range = std::get_if<SweepRange>(&sweep_.keys[i].values);
        if (range != nullptr && range->lo < 0 && range->hi > 0) ends.push_back(-range->lo / (range->hi - range->lo));
        const double end = ends[random_.next_up_to(ends.size() - 1)];
        const double sign = end == 0 ? 1 : (end == 1 ? -1 : (random_.next_up_to(1) == 0 ? 1 : -1));
        place[i] = std::clamp(end + sign * distance, 0.0, 1.0);
    }
    return point_in(sweep_, place);
}

bool Search::is_new(const std::vector<FileCoverage>& files) {
    const std::size_t before = lines_.size();
    for (const FileCoverage& file : files) {
        for (const CoveredLine& line : file.lines) {
            if (line.ran) lines_.emplace(file.file, line.line);
        }
        for (const CoveredBranch& branch : file.branches) {
            constexpr std::int64_t lines = 1'000'000;
            if (branch.ran) lines_.emplace(file.file, lines * (1 + branch.way + 2 * branch.number) + branch.line);
        }
    }
    return lines_.size() > before;
}

void Search::add(const SweepPoint& point, const RunResult& result) {
    const std::size_t keys = sweep_.keys.size();
    sweep_ = with_drawn(std::move(sweep_), result.drawn);
    // Earlier runs did not draw the new values, and get the middle for each.
    if (sweep_.keys.size() > keys) {
        for (Seen& seen : seen_) seen.place.resize(sweep_.keys.size(), 0.5);
        for (Shares& place : had_new_lines_) place.resize(sweep_.keys.size(), 0.5);
    }
    Seen seen{.place = shares_of(sweep_, with_drawn(point, result.drawn))};
    for (const ConditionMargin& margin : result.margins) {
        const std::string name = margin.kind + " " + margin.condition;
        // If a deadline was met, the time left is more useful than the number that met it.
        const bool met = margin.left && margin.kind != "maintain";
        if (margin.left) seen.margins.emplace(name + " left", *margin.left);
        if (margin.margin && !met && !margin.comparison.empty()) seen.margins.emplace(name, *margin.margin);
    }
    if (is_new(result.coverage)) had_new_lines_.push_back(seen.place);
    seen_.push_back(std::move(seen));
}

}  // namespace nezumi
