// Reduces the points of long curves before they are sent: a plot is only a few hundred pixels wide.
#include "engine/trace/recent_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "engine/base/visible.hpp"

namespace nezumi {
namespace {

using Point = std::pair<double, double>;
using Points = std::vector<Point>;

constexpr std::size_t most_points = 1200;
constexpr std::size_t spans = most_points / 4;

// Keeps all changes of a text; of numbers the first, last, least and largest value of each span of samples.
Points shortened(const Curve& curve) {
    const Points& all = curve.points;
    if (all.size() <= most_points) return all;
    Points kept;
    if (!curve.texts.empty()) {
        std::unique_copy(all.begin(), all.end(), std::back_inserter(kept),
                         [](const Point& a, const Point& b) { return a.second == b.second; });
        return kept;
    }
    const auto by_value = [](const Point& a, const Point& b) { return a.second < b.second; };
    for (std::size_t i = 0; i < spans; ++i) {
        const auto place = [&](std::size_t span) {
            return all.begin() + static_cast<std::ptrdiff_t>(span * all.size() / spans);
        };
        const auto begin = place(i), end = place(i + 1);
        const auto [low, high] = std::minmax_element(begin, end, by_value);
        auto chosen = {begin, std::min(low, high), std::max(low, high), end - 1};
        for (const auto& each : chosen) {
            if (kept.empty() || kept.back() != *each) kept.push_back(*each);
        }
    }
    return kept;
}

constexpr std::size_t values_per_curve = 4;  // name, times, values, texts

}  // namespace

Expected<RecentCurves> recent_curves(Trace& trace, std::string_view name, double seconds, double now) {
    const auto found = trace.remember_part(name);
    if (!found) return Unexpected(found.error());
    const Series& series = *found->series;
    const auto& labels = series.labels();
    const auto has_part = [&](const std::string& label) { return is_within(label, found->part); };
    if (!labels.empty() && std::none_of(labels.begin(), labels.end(), has_part))
        return failure(fmt::format("{} has no '{}'{}", found->whole, shown(found->part),
                                   did_you_mean(found->part, {labels.begin(), labels.end()})));
    RecentCurves recent{.whole = found->whole, .part = found->part, .first = now, .now = now};
    if (series.size() > 0) recent.first = std::min(now, series.seconds(0));
    recent.curves = curves_of(series, found->part, std::max(recent.first, now - seconds), now, found->holds);
    return recent;
}

PlainData to_plain(const RecentCurves& recent) {
    PlainData data{.values = {recent.first, recent.now}, .tables = {}};
    for (const Curve& curve : recent.curves) {
        std::vector<double> times, values;
        for (const auto& [time, value] : shortened(curve)) {
            times.push_back(time);
            values.push_back(value);
        }
        for (Value each : {Value{curve.name}, Value{std::move(times)}, Value{std::move(values)}, Value{curve.texts}})
            data.values.push_back(std::move(each));
    }
    return data;
}

Expected<RecentCurves> read_curves(const PlainData& data) {
    const auto& all = data.values;
    const auto malformed = [] { return failure("malformed curves"); };
    if (all.size() < 2 || all.size() % values_per_curve != 2) return malformed();
    const auto *first = all[0].get_if<double>(), *now = all[1].get_if<double>();
    if (first == nullptr || now == nullptr || !std::isfinite(*first) || !std::isfinite(*now)) return malformed();
    RecentCurves recent{.first = *first, .now = *now};
    for (std::size_t i = 2; i < all.size(); i += values_per_curve) {
        const auto* name = all[i].get_if<std::string>();
        const auto* times = all[i + 1].get_if<std::vector<double>>();
        const auto* values = all[i + 2].get_if<std::vector<double>>();
        const auto* texts = all[i + 3].get_if<std::vector<std::string>>();
        if (name == nullptr || times == nullptr || values == nullptr || texts == nullptr) return malformed();
        if (times->size() != values->size() || times->empty()) return malformed();
        Curve curve{.name = visible(*name), .texts = *texts};
        for (std::size_t point = 0; point < times->size(); ++point) {
            const double time = (*times)[point], value = (*values)[point];
            const bool is_place = value >= 0 && value < static_cast<double>(texts->size());
            if (!std::isfinite(time) || !std::isfinite(value) || (!texts->empty() && !is_place)) return malformed();
            curve.points.emplace_back(time, value);
        }
        recent.curves.push_back(std::move(curve));
    }
    return recent;
}

}  // namespace nezumi
