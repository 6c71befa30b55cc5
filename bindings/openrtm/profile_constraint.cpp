// A constraint is one condition, several conditions joined by And or Or, or one condition for each element or name.
#include "bindings/openrtm/profile_constraint.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <utility>

#include "bindings/openrtm/profile_parameter.hpp"
#include "bindings/openrtm/profile_xml.hpp"
#include "engine/base/number_in.hpp"
#include "engine/base/trimmed.hpp"

namespace nezumi::openrtm {
namespace {

// The names of condition elements, used for reading and writing.
constexpr const char* equal_to = "propertyIsEqualTo";
constexpr const char* at_least = "propertyIsGreaterThanOrEqualTo";
constexpr const char* at_most = "propertyIsLessThanOrEqualTo";
constexpr const char* above = "propertyIsGreaterThan";
constexpr const char* below = "propertyIsLessThan";
constexpr const char* between = "propertyIsBetween";

std::string text_in(const pugi::xml_node& node, std::string_view name) { return element_of(node, name).text().get(); }

class ConstraintReader {
public:
    explicit ConstraintReader(bool is_integer) : is_integer_(is_integer) {}

    void read(const pugi::xml_node& constraint) {
        for (const pugi::xml_node& form : elements_of(constraint)) {
            const std::string_view name = local_name(form.name());
            if (name == "ConstraintUnitType") {
                for (const pugi::xml_node& condition : elements_of(form)) read_condition(condition);
            } else if (name == "ConstraintHashType") {
                read_choices(form);
                result_.remarks.emplace_back("the names of its choices");
            } else if (name == "ConstraintListType") {
                read_elements(form);
            } else {
                result_.remarks.push_back(fmt::format("the constraint <{}>", shown(form.name())));
            }
        }
    }
    ProfileConstraint take() { return std::move(result_); }

private:
    void read_condition(const pugi::xml_node& condition) {
        const std::string_view name = local_name(condition.name());
        if (name == "And") {
            for (const pugi::xml_node& each : elements_of(condition, "Constraint")) read(each);
        } else if (name == "Or") {
            read_choices(condition);
        } else if (name == equal_to) {
            result_.choices.push_back(text_in(condition, "Literal"));
        } else if (name == between) {
            bound(condition, "LowerBoundary", 1, true);
            bound(condition, "UpperBoundary", -1, true);
        } else if (name == at_least || name == above) {
            bound(condition, "Literal", 1, name == at_least);
        } else if (name == at_most || name == below) {
            bound(condition, "Literal", -1, name == at_most);
        } else {
            result_.remarks.push_back(fmt::format("the constraint <{}>", shown(condition.name())));
        }
    }

    // Reads conditions joined by Or: the value equals one of several choices.
    void read_choices(const pugi::xml_node& any) {
        ConstraintReader each(is_integer_);
        for (const pugi::xml_node& constraint : elements_of(any, "Constraint")) each.read(constraint);
        ProfileConstraint read = each.take();
        if (read.min || read.max) {
            result_.remarks.emplace_back("a constraint of several ranges");
            return;
        }
        std::move(read.choices.begin(), read.choices.end(), std::back_inserter(result_.choices));
        std::move(read.remarks.begin(), read.remarks.end(), std::back_inserter(result_.remarks));
    }

    // Reads a constraint for each element of an array. nezumi has one constraint for all, so they must be equal.
    void read_elements(const pugi::xml_node& list) {
        std::optional<ProfileConstraint> common;
        for (const pugi::xml_node& constraint : elements_of(list, "Constraint")) {
            ProfileConstraint next = read_constraint(constraint, is_integer_);
            if (common && next != *common) {
                result_.remarks.emplace_back("a constraint that differs between elements");
                return;
            }
            common = std::move(next);
        }
        if (common) result_ = std::move(*common);
    }

    // A lower bound (`side` 1) or an upper one (-1).
    void bound(const pugi::xml_node& condition, std::string_view name, int side, bool is_inclusive) {
        const std::string text = text_in(condition, name);
        const std::string_view digits = trimmed(text);
        if (digits.empty()) return;
        const auto number = signed_finite_in(digits);
        if (!number) {
            result_.remarks.push_back(fmt::format("a bound '{}' that is not a number", shown(text)));
            return;
        }
        double value = *number;
        if (!is_inclusive && is_integer_) value = side > 0 ? std::floor(value) + 1 : std::ceil(value) - 1;
        if (!is_inclusive && !is_integer_)
            result_.remarks.push_back(fmt::format("that {} itself is not allowed (bounds are inclusive here)", value));
        std::optional<double>& known = side > 0 ? result_.min : result_.max;
        if (!known || (side > 0 ? value > *known : value < *known)) known = value;
    }

    bool is_integer_;
    ProfileConstraint result_;
};

pugi::xml_node add_condition(pugi::xml_node constraint, const char* name) {
    return constraint.append_child("rtc:ConstraintUnitType").append_child((std::string("rtc:") + name).c_str());
}

void add_text(pugi::xml_node condition, const char* name, const std::string& text) {
    condition.append_child(name).text().set(text.c_str());
}

void add_comparison(pugi::xml_node constraint, const char* name, const std::string& literal) {
    pugi::xml_node condition = add_condition(constraint, name);
    condition.append_attribute("rtc:matchCase") = "false";
    add_text(condition, "rtc:Literal", literal);
}

void add_bounds(const ParameterSpec& spec, pugi::xml_node constraint) {
    if (spec.min && spec.max) {
        const pugi::xml_node condition = add_condition(constraint, between);
        add_text(condition, "rtc:LowerBoundary", fmt::format("{}", *spec.min));
        add_text(condition, "rtc:UpperBoundary", fmt::format("{}", *spec.max));
    } else if (spec.min) {
        add_comparison(constraint, at_least, fmt::format("{}", *spec.min));
    } else {
        add_comparison(constraint, at_most, fmt::format("{}", *spec.max));
    }
}

void add_choices(const ParameterSpec& spec, pugi::xml_node constraint) {
    if (spec.choices.size() == 1) return add_comparison(constraint, equal_to, profile_text(spec.choices.front()));
    pugi::xml_node any = add_condition(constraint, "Or");
    for (const Value& choice : spec.choices)
        add_comparison(any.append_child("rtc:Constraint"), equal_to, profile_text(choice));
}

}  // namespace

ProfileConstraint read_constraint(const pugi::xml_node& constraint, bool is_integer) {
    ConstraintReader reader(is_integer);
    reader.read(constraint);
    return reader.take();
}

void write_constraint(const ParameterSpec& spec, pugi::xml_node configuration) {
    const bool has_bounds = spec.min || spec.max;
    if (!has_bounds && spec.choices.empty()) return;
    pugi::xml_node constraint = configuration.append_child("rtc:Constraint");
    if (has_bounds && !spec.choices.empty()) {
        pugi::xml_node both = add_condition(constraint, "And");
        add_bounds(spec, both.append_child("rtc:Constraint"));
        add_choices(spec, both.append_child("rtc:Constraint"));
    } else if (has_bounds) {
        add_bounds(spec, constraint);
    } else {
        add_choices(spec, constraint);
    }
}

}  // namespace nezumi::openrtm
