// Checks numbers and lengths against the limits of their fields.
#include "engine/values/limits.hpp"

#include <fmt/format.h>

#include <limits>
#include <string_view>
#include <type_traits>

#include "engine/values/walk.hpp"

namespace nezumi {
namespace {

std::string range_text(double min, double max) {
    if (max == std::numeric_limits<double>::infinity()) return fmt::format("from {} on", min);
    if (min == -std::numeric_limits<double>::infinity()) return fmt::format("up to {}", max);
    return fmt::format("from {} to {}", min, max);
}

std::string explain_number(const FieldLimits& limits, const ValueView& value) {
    return visit_number(value, [&]<class T>(const T& number) -> std::string {
        const auto wide = static_cast<double>(number);
        if (!(wide < limits.min) && !(wide > limits.max)) return "";
        return fmt::format("expected {} {}, got {}", std::is_integral_v<T> ? "an integer" : "a number",
                           range_text(limits.min, limits.max), number);
    });
}

}  // namespace

std::string explain_misfit(const FieldLimits& limits, const ValueView& value) {
    const auto explain_length = [&](std::size_t length, std::string_view of) {
        return length <= limits.length ? "" : fmt::format("expected at most {} {}, got {}", limits.length, of, length);
    };
    switch (value.type->kind) {
        case Type::Kind::array:
        case Type::Kind::sequence: {
            std::string wrong = explain_length(value.count(), "elements");
            if (!wrong.empty() || !value.type->element->is_number()) return wrong;
            std::size_t index = 0;
            for_each_element(value, [&](const ValueView& element) {
                ++index;
                return (wrong = explain_number(limits, element)).empty();
            });
            return wrong.empty() ? wrong : fmt::format("element {} {}", index, wrong);
        }
        case Type::Kind::text: return explain_length(value.as<std::string>().size(), "bytes");
        case Type::Kind::octets: return explain_length(value.as<Octets>().size(), "bytes");
        default: return value.type->is_number() ? explain_number(limits, value) : "";
    }
}

bool fits(const FieldLimits& limits, const ValueView& value) {
    if (!value.type->is_number()) return explain_misfit(limits, value).empty();
    return visit_number(value, [&](const auto& number) {
        const auto wide = static_cast<double>(number);
        return !(wide < limits.min) && !(wide > limits.max);
    });
}

namespace {

std::string find_misfit_in(const ValueView& value, const LeafPath& path) {
    std::string wrong;
    switch (value.type->kind) {
        case Type::Kind::structure:
            for (const Type::Field& field : value.type->fields) {
                const LeafPath here = path.field(field.name);
                if (field.limits != nullptr) wrong = explain_misfit(*field.limits, value.field(field));
                if (!wrong.empty()) return fmt::format("field '{}' {}", here.text(), wrong);
                if (!field.type->is_single()) wrong = find_misfit_in(value.field(field), here);
                if (!wrong.empty()) return wrong;
            }
            return wrong;
        case Type::Kind::array:
        case Type::Kind::sequence: {
            std::size_t index = 0;
            if (value.type->element->is_single()) return wrong;
            for_each_element(value, [&](const ValueView& element) {
                return (wrong = find_misfit_in(element, path.element(++index))).empty();
            });
            return wrong;
        }
        default: return wrong;
    }
}

}  // namespace

std::string find_misfit(const ValueView& value) { return find_misfit_in(value, {}); }

}  // namespace nezumi
