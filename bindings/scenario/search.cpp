// Rounds have a fixed size, whatever the number of jobs.
#include "bindings/scenario/search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace nezumi {
namespace {

constexpr std::size_t first_round = 12;
constexpr std::size_t round_size = 6;
constexpr std::size_t random_of_round = 1;
// How far below the mean of the model a point counts, in standard deviations: near the best ones, and where few are.
constexpr std::array optimism{0.0, 2.0, 0.5};
constexpr std::size_t most_modelled = 200;  // points of a model: the nearest to failing, and the latest

std::vector<SweepValue> choices_of(const DrawnValue& drawn) {
    std::vector<SweepValue> values;
    for (const std::string& choice : drawn.choices) values.push_back(text_value(choice));
    return values;
}

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
        if (value_of(point, each.name) != nullptr) continue;
        point.emplace_back(each.name,
                           each.choices.empty() ? number_value(each.range, each.number) : text_value(each.text));
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
    const std::size_t round = rounds_++;
    const std::size_t count = std::min(most, round == 0 ? first_round : round_size);
    std::vector<SweepPoint> points;
    if (round > 0 && !sweep_.keys.empty()) {
        points = modelled_points(count - std::min(count, random_of_round));
        if (!had_new_lines_.empty() && points.size() > 1) points.back() = near_new_lines();
    }
    while (points.size() < count) points.push_back(random_point());
    for (SweepPoint& point : points) {
        // Does not repeat a point: its result would be the same. A small space may have no new point, so tries are
        // limited.
        constexpr int most_tries = 20;
        for (int i = 0; i < most_tries && !names_.insert(text_of(point)).second; ++i) point = random_point();
    }
    return points;
}

// One condition after the other. Each chosen point counts as seen, with the value that the model expects, so that the
// next one is elsewhere.
std::vector<SweepPoint> Search::modelled_points(std::size_t count) {
    std::set<std::string> conditions;
    for (const Seen& seen : seen_) {
        for (const auto& margin : seen.margins) conditions.insert(margin.first);
    }
    std::vector<SweepPoint> points;
    std::vector<Shares> chosen;
    for (std::size_t tried = 0; points.size() < count && !conditions.empty() && tried < 4 * count; ++tried) {
        auto condition = conditions.begin();
        std::advance(condition, static_cast<std::ptrdiff_t>(turn_++ % conditions.size()));
        std::vector<std::pair<double, std::size_t>> known;
        for (std::size_t i = 0; i < seen_.size(); ++i) {
            const auto margin = seen_[i].margins.find(*condition);
            if (margin != seen_[i].margins.end()) known.emplace_back(margin->second, i);
        }
        std::sort(known.begin(), known.end());
        if (known.size() < 3 || known.front().first == known.back().first) continue;
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
        for (const Shares& place : chosen) {
            places.push_back(place);
            values.push_back(values[values.size() / 2]);
        }
        std::vector<bool> is_choice;
        for (const SweepKey& key : sweep_.keys) is_choice.push_back(!std::holds_alternative<SweepRange>(key.values));
        const MarginModel model(std::move(places), values, std::move(is_choice));
        points.push_back(point_in(sweep_, model.least_place(optimism[points.size() % optimism.size()])));
        chosen.push_back(shares_of(sweep_, points.back()));
    }
    return points;
}

// One or all values of a run that had new lines, changed a little.
SweepPoint Search::near_new_lines() {
    Shares place = had_new_lines_[random_.next_up_to(had_new_lines_.size() - 1)];
    const std::uint64_t only = random_.next_up_to(place.size());
    for (std::size_t i = 0; i < place.size(); ++i) {
        const double change = 0.2 * (random_.next_fraction() - 0.5);
        if (only == place.size() || only == i) place[i] = std::clamp(place[i] + change, 0.0, 1.0);
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
    // Runs before did not draw these values.
    if (sweep_.keys.size() > keys) {
        for (Seen& seen : seen_) seen.place.resize(sweep_.keys.size(), 0.5);
        for (Shares& place : had_new_lines_) place.resize(sweep_.keys.size(), 0.5);
    }
    Seen seen{.place = shares_of(sweep_, with_drawn(point, result.drawn))};
    for (const ConditionMargin& margin : result.margins) {
        const std::string name = margin.kind + " " + margin.condition;
        // A deadline that was met says more than the number that met it.
        const bool met = margin.left && margin.kind != "maintain";
        if (margin.left) seen.margins.emplace(name + " left", *margin.left);
        if (margin.margin && !met && !margin.comparison.empty()) seen.margins.emplace(name, *margin.margin);
    }
    if (is_new(result.coverage)) had_new_lines_.push_back(seen.place);
    seen_.push_back(std::move(seen));
}

}  // namespace nezumi
