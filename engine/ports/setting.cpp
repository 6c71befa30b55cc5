// Checks the numbers of fields by their rules.
#include "engine/ports/setting.hpp"

#include <fmt/format.h>

#include <cmath>
#include <initializer_list>

#include "engine/base/number_in.hpp"

namespace nezumi {
namespace {

// The default bound of `Rule` is only a guard against nonsense, so descriptions of fields omit it.
bool has_own_bound(const Rule& rule) { return rule.most < Rule{}.most; }

}  // namespace

std::string words_for(const Rule& rule) {
    const bool bounded = has_own_bound(rule);
    switch (rule.range) {
        case NumberRange::any:
            return bounded ? fmt::format("a number from {} to {}", -rule.most, rule.most) : "a number";
        case NumberRange::not_negative:
            return bounded ? fmt::format("a number from 0 to {}", rule.most) : "a number from 0 on";
        case NumberRange::positive:
            return bounded ? fmt::format("a positive number up to {}", rule.most) : "a positive number";
    }
    return "a number";
}

std::string check_number(double number, const Rule& rule, std::string_view unit) {
    if (!std::isfinite(number))
        return fmt::format("expected a finite number, got {}", std::isnan(number) ? "nan" : fmt::format("{}", number));
    if ((rule.range == NumberRange::positive && number <= 0) || (rule.range == NumberRange::not_negative && number < 0))
        return fmt::format("expected {}, got {}", words_for(rule), number);
    if (std::abs(number) > rule.most)
        return fmt::format("expected {}, got {}",
                           has_own_bound(rule) ? words_for(rule) : number_within(rule.most, number), number);
    const bool may_be_zero = rule.range == NumberRange::not_negative;
    if (rule.least <= 0 || number >= rule.least || (number == 0 && may_be_zero)) return "";
    return fmt::format("expected at least {}{}{}{}, got {}", rule.least, unit.empty() ? "" : " ", unit,
                       may_be_zero ? ", or 0" : "", number);
}

namespace {

std::string check_numbers(std::initializer_list<double> numbers) {
    for (const double number : numbers) {
        if (std::string problem = check_number(number, {}, ""); !problem.empty()) return problem;
    }
    return "";
}

std::string check_fields(const ValueView& record, const std::string& path);

std::string check_member(const ValueView& value, const std::string& path, const Rule& rule, std::string_view unit) {
    const Type& type = *value.type;
    if (type.kind == Type::Kind::float64) {
        const std::string problem = check_number(value.as<double>(), rule, unit);
        return problem.empty() ? problem : "field '" + path + "' " + problem;
    }
    if (type.kind == Type::Kind::optional)
        return value.count() > 0 ? check_member({*type.element, value.first()}, path, rule, unit) : "";
    if (is_record(type)) return check_fields(value, path + ".");
    const bool is_place = &type == &type_of<Point2D>() || &type == &type_of<Point3D>();
    std::string problem;
    for (const Type::Field& axis : type.fields) {
        if (is_place && problem.empty()) problem = check_member(value.field(axis), path + "." + axis.name, rule, unit);
    }
    return problem;
}

std::string check_fields(const ValueView& record, const std::string& path) {
    for (const Type::Field& field : record.type->fields) {
        std::string problem = check_member(record.field(field), path + field.name, *field.rule, field.unit);
        if (!problem.empty()) return problem;
    }
    return "";
}

}  // namespace

std::string usage_of(const Type& record, unsigned kinds) {
    std::string text;
    for (const Type::Field& field : record.fields) {
        if (kinds != 0 && field.rule->of != 0 && (field.rule->of & kinds) == 0) continue;
        text += (text.empty() ? "{ " : ", ") + field.name + " =";
    }
    return text + " }";
}

Expected<void> check_record(const ValueView& record, const Place& place) {
    const std::string problem = check_fields(record, "");
    if (!problem.empty()) return failure(record.type->name + ": " + problem, place);
    return {};
}

std::string check_pose(const Pose2D& pose) { return check_numbers({pose.position.x, pose.position.y, pose.heading}); }

std::string check_pose(const Pose3D& pose) {
    const auto& [at, turn] = pose;
    return check_numbers({at.x, at.y, at.z, turn.r, turn.p, turn.y});
}

}  // namespace nezumi
