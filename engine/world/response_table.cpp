// Converts a distance to a sensor value: between points, before the first, beyond the last.
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/base/csv.hpp"
#include "engine/world/robot_spec.hpp"

namespace nezumi {

Expected<ResponseTable> ResponseTable::from_points(std::vector<Point> points, double range, double nothing,
                                                   double minimum, double maximum) {
    if (points.size() < 2)
        return failure(fmt::format("a response table needs at least two points, got {}", points.size()));
    if (!std::isfinite(range) || range <= 0)
        return failure(fmt::format("a range of {} m is not a positive number", range));
    if (!std::isfinite(nothing)) return failure("the value for nothing in sight is not a finite number");
    if (std::isnan(minimum) || std::isnan(maximum)) return failure("the values' minimum or maximum is not a number");
    if (minimum > maximum)
        return failure(fmt::format("the values' minimum {} is above their maximum {}", minimum, maximum));
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!std::isfinite(points[i].distance) || points[i].distance < 0 || !std::isfinite(points[i].value)) {
            return failure(fmt::format("point {} ({} m, {}) is not a distance and a finite value", i + 1,
                                       points[i].distance, points[i].value));
        }
        if (i > 0 && points[i].distance <= points[i - 1].distance) {
            return failure(fmt::format("distances must ascend: {} m comes after {} m", points[i].distance,
                                       points[i - 1].distance));
        }
    }
    ResponseTable table;
    table.range_ = range;
    table.nothing_ = nothing;
    table.minimum_ = minimum;
    table.maximum_ = maximum;
    const Point a = points[0];
    const Point b = points[1];
    if (a.distance > 0 && a.value > 0 && b.value > 0) {
        table.exponent_ = std::log(b.value / a.value) / std::log(b.distance / a.distance);
    }
    table.points_ = std::move(points);
    return table;
}

ResponseTable ResponseTable::from_samples(std::vector<double> samples, double range, double nothing) {
    assert(samples.size() >= 2 && range > 0);
    ResponseTable table;
    table.range_ = range;
    table.nothing_ = nothing;
    table.samples_per_metre_ = static_cast<double>(samples.size() - 1) / range;
    const auto [least, greatest] = std::minmax_element(samples.begin(), samples.end());
    table.minimum_ = std::min(*least, nothing);
    table.maximum_ = std::max(*greatest, nothing);
    table.samples_ = std::move(samples);
    return table;
}

Expected<ResponseTable> ResponseTable::with_points(std::vector<Point> points, double range) const {
    double least = minimum_, greatest = maximum_;
    for (const Point& point : points) {
        least = std::min(least, point.value);
        greatest = std::max(greatest, point.value);
    }
    return from_points(std::move(points), range, nothing_, least, greatest);
}

double ResponseTable::operator()(double distance) const {
    if (!(distance <= range_)) return nothing_;
    if (distance < 0) distance = 0;
    if (!samples_.empty()) {
        const double at = distance * samples_per_metre_;
        const std::size_t index = std::min(static_cast<std::size_t>(at), samples_.size() - 2);
        const double before = samples_[index];
        return before + (samples_[index + 1] - before) * (at - static_cast<double>(index));
    }
    if (points_.empty()) return nothing_;

    const auto after = std::upper_bound(points_.begin(), points_.end(), distance,
                                        [](double d, const Point& point) { return d < point.distance; });
    if (after == points_.begin() && exponent_ != 0) {
        return clamp(after->value * std::pow(distance / after->distance, exponent_));
    }
    const Point end{range_, nothing_};
    const bool beyond = after == points_.end();
    if (beyond && distance >= range_) return range_ > points_.back().distance ? nothing_ : clamp(points_.back().value);
    const Point& left = after == points_.begin() ? *after : *(after - 1);
    const Point& right = after == points_.begin() ? *(after + 1) : beyond ? end : *after;
    return clamp(left.value +
                 (right.value - left.value) * ((distance - left.distance) / (right.distance - left.distance)));
}

// A binary search works for both slopes.
double distance_at(const ResponseTable& response, double value) {
    double near = 0, far = response.range();
    const double at_near = response(near), at_far = response(far);
    const bool falls = at_near > at_far;
    if (falls ? value <= at_far : value >= at_far) return far;
    if (falls ? value >= at_near : value <= at_near) return near;
    for (int i = 0; i < 40; ++i) {
        const double middle = (near + far) / 2;
        ((response(middle) > value) == falls ? near : far) = middle;
    }
    return far;
}

Expected<std::vector<ResponseTable::Point>> read_csv_response(std::string_view text, const std::string& file) {
    const auto rows =
        read_csv(text, file, {{"distance_m", CsvColumn::Range::not_negative}, {"value", CsvColumn::Range::any}});
    if (!rows) return Unexpected(rows.error());
    std::vector<ResponseTable::Point> points;
    for (const CsvRow& row : *rows) {
        if (!points.empty() && row.values[0] <= points.back().distance) {
            return failure(fmt::format("column 'distance_m': distances must ascend, got {} after {}", row.values[0],
                                       points.back().distance),
                           {file, row.line});
        }
        points.push_back({row.values[0], row.values[1]});
    }
    if (points.size() < 2)
        return failure(fmt::format("a response table needs at least two rows, got {}", points.size()), {file});
    return points;
}

}  // namespace nezumi
