// The sensors of a robot file: positions, ranges, and the conversion of a distance to a value.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "bindings/lua/files/robot_fields.hpp"
#include "engine/records/read_record.hpp"
#include "engine/world/robot_fields.hpp"

namespace nezumi {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double twelve_bits = 4095;  // the largest value of a table, by default

void read_table(Fields& sensor, SensorSpec& spec, bool range_given, double nothing, double minimum, double maximum,
                const RobotFileHelp& help) {
    FieldCheck& check = sensor.check();
    const FieldPath path = sensor.path_of("table");
    const Value& value = *sensor.field("table");
    std::vector<ResponseTable::Point> points;
    if (const std::string* file = value.get_if<std::string>()) {
        auto read = help.read_table(path, *file);
        if (!read) {
            const Error& error = read.error();
            return error.place.file.empty() ? check.explain(path, error.message) : check.wrong(error);
        }
        points = std::move(*read);
    } else if (const FileTable* table = value.get_if<FileTable>()) {
        points = read_points(sensor, *table);
    } else {
        return check.wrong(
            path, fmt::format("expected a file's name or points {{ distance, value }}, got {}", kind_of(value)));
    }
    if (!check.ok()) return;
    double largest = twelve_bits;
    bool negative = false;
    for (const ResponseTable::Point& point : points) {
        largest = std::max(largest, point.value);
        negative = negative || point.value < 0;
    }
    // Beyond its last point, a table fades to zero over the same distance.
    if (!range_given && !points.empty()) spec.range = 2 * points.back().distance;
    auto made = ResponseTable::from_points(std::move(points), spec.range, nothing,
                                           minimum > -infinity ? minimum
                                           : negative          ? -largest
                                                               : 0,
                                           maximum < infinity ? maximum : largest);
    if (!made) return check.explain(path, made.error().message);
    spec.response = std::move(*made);
    spec.has_response = true;
}

void read_response(Fields& sensor, SensorSpec& spec, bool nothing_given, double nothing, double minimum, double maximum,
                   const RobotFileHelp& help) {
    FieldCheck& check = sensor.check();
    const FieldPath path = sensor.path_of("response");
    const Value& value = *sensor.field("response");
    if (!value.is<FileFunction>()) {
        return check.wrong(path, fmt::format("expected a function of the distance, got {}", kind_of(value)));
    }
    std::vector<double> distances;
    for (std::size_t i = 0; i <= response_samples; ++i) {
        distances.push_back(spec.range * static_cast<double>(i) / static_cast<double>(response_samples));
    }
    if (!nothing_given) distances.push_back(infinity);
    auto values = help.call(path, distances);
    if (!values) {
        const Error& error = values.error();
        return error.place.file.empty() ? check.explain(path, error.message) : check.wrong(error);
    }
    const double at_infinity = nothing_given ? nothing : values->back();
    values->resize(response_samples + 1);
    double least = infinity;
    double greatest = -infinity;
    for (const double v : *values) {
        if (!std::isfinite(v)) continue;
        least = std::min(least, v);
        greatest = std::max(greatest, v);
    }
    if (least > greatest) return check.explain(path, "returned only values that are not finite numbers");
    // A formula such as 1 / d is infinite at 0: it gets the largest finite or allowed value.
    for (double& v : *values) {
        if (v == infinity) v = maximum < infinity ? maximum : greatest;
        if (v == -infinity) v = minimum > -infinity ? minimum : least;
        v = std::clamp(v, minimum, maximum);
    }
    const double last = values->back();
    const double seen_nothing = !std::isfinite(at_infinity) ? last
                                : nothing_given             ? nothing
                                                            : std::clamp(at_infinity, minimum, maximum);
    spec.response = ResponseTable::from_samples(std::move(*values), spec.range, seen_nothing);
    spec.has_response = true;
}

void check_minimum(Fields& sensor, const SensorSpec& spec) {
    if (spec.minimum >= spec.range)
        sensor.check().wrong(sensor.path_of("minimum"),
                             fmt::format("expected less than the range of {} m, got {}", spec.range, spec.minimum));
}

void read_scan(Fields& sensor, SensorSpec& spec) {
    constexpr double full_turn = 2 * std::numbers::pi;
    check_minimum(sensor, spec);
    if (!sensor.has("cone")) spec.cone = full_turn;
    if (!sensor.has("rays")) spec.rays = 360;
    if (spec.cone <= 0 || spec.cone > full_turn + 1e-6)
        sensor.check().wrong(sensor.path_of("cone"),
                             fmt::format("expected a field of view above 0 and up to 2 pi rad, got {}", spec.cone));
    if (spec.rays < 2)
        sensor.check().wrong(
            sensor.path_of("rays"),
            fmt::format("expected 2 or more rays, got {}: for a single ray use kind = 'range'", spec.rays));
}

void read_range_sensor(Fields& sensor, SensorSpec& spec, const RobotFileHelp& help) {
    const bool range_given = sensor.has("range");
    check_minimum(sensor, spec);
    if (!sensor.has("rays")) spec.rays = spec.cone > 0 ? 5 : 1;
    double nothing = 0;
    double minimum = -infinity;
    double maximum = infinity;
    const bool has_table = sensor.has("table");
    const bool has_function = sensor.has("response");
    if (!has_table && !has_function) {
        for (const std::string_view name : {"nothing", "min_value", "max_value"}) {
            if (sensor.has(name))
                sensor.check().wrong(sensor.path_of(name),
                                     "can be used only for a sensor with a 'table' or a 'response'");
        }
        return;
    }
    const bool nothing_given = sensor.number("nothing", nothing);
    sensor.number("min_value", minimum);
    sensor.number("max_value", maximum);
    if (minimum > maximum)
        sensor.check().explain(sensor.path_of("min_value"), fmt::format("{} is above max_value {}", minimum, maximum));
    if (has_table && has_function)
        sensor.check().wrong(sensor.path_of("response"), "and 'table' exclude each other: give one of them");
    if (!sensor.check().ok()) return;
    if (has_table) {
        read_table(sensor, spec, range_given, nothing, minimum, maximum, help);
    } else {
        read_response(sensor, spec, nothing_given, nothing, minimum, maximum, help);
    }
}

}  // namespace

std::vector<ResponseTable::Point> read_points(Fields& sensor, const FileTable& table) {
    std::vector<ResponseTable::Point> points;
    for (const Value& element : table.elements) {
        const FileTable* point = element.get_if<FileTable>();
        const bool is_pair = point != nullptr && point->elements.size() == 2;
        const auto distance = is_pair ? number_of(point->elements[0]) : std::nullopt;
        const auto value = is_pair ? number_of(point->elements[1]) : std::nullopt;
        if (!distance || !value) {
            sensor.check().wrong(sensor.path_of("table"), "expected a file's name or points { distance, value }");
            return {};
        }
        points.push_back({*distance, *value});
    }
    return points;
}

SensorSpec read_sensor_fields(const std::string& name, Fields& sensor, const BodySpec& body,
                              const RobotFileHelp& help) {
    SensorSpec spec;
    spec.name = name;
    read_record(sensor, spec);
    if (name == "velocity" || name == "odometry") {
        sensor.check().wrong_at(
            sensor.path(),
            fmt::format("a sensor can't have the name '{}': it is reserved for a measurement of the wheels", name));
    }
    spec.at = on_body(body, spec.at);
    if (spec.kind == SensorSpec::Kind::range) read_range_sensor(sensor, spec, help);
    if (spec.kind == SensorSpec::Kind::scan) read_scan(sensor, spec);
    if (spec.kind == SensorSpec::Kind::neighbours && !spec.on.empty())
        sensor.check().wrong(sensor.path_of("on"), "can't be used for neighbours: that sensor is always on the hull");
    return spec;
}

}  // namespace nezumi
