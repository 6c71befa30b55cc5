// Checks the values of parameters, and writes the error messages.
#include "engine/components/parameter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/list.hpp"
#include "engine/base/lua_text.hpp"
#include "engine/components/parameter_fields.hpp"
#include "engine/values/value_text.hpp"

namespace nezumi {
namespace {

using Integers = std::vector<std::int64_t>;
using Doubles = std::vector<double>;

// A whole number that a double holds exactly, as an integer; nothing otherwise.
std::optional<std::int64_t> to_integer(double value) {
    constexpr double limit = 9223372036854775808.0;  // 2^63
    if (!(value >= -limit && value < limit) || value != std::floor(value)) return std::nullopt;
    return static_cast<std::int64_t>(value);
}

bool is_array(const Value& value) { return value.type().kind == Type::Kind::sequence; }

// Converts `value` to the type of `like` if this loses nothing.
std::optional<Value> convert(const Value& like, const Value& value) {
    if (&like.type() == &value.type()) return value;
    if (const auto* whole = value.get_if<std::int64_t>(); whole != nullptr && like.is<double>())
        return static_cast<double>(*whole);
    if (const auto* number = value.get_if<double>(); number != nullptr && like.is<std::int64_t>()) {
        if (const auto whole = to_integer(*number)) return *whole;
    }
    if (const auto* whole = value.get_if<Integers>(); whole != nullptr && like.is<Doubles>())
        return Doubles(whole->begin(), whole->end());
    if (const auto* numbers = value.get_if<Doubles>(); numbers != nullptr && like.is<Integers>()) {
        Integers all;
        for (const double number : *numbers) {
            const auto whole = to_integer(number);
            if (!whole) return std::nullopt;
            all.push_back(*whole);
        }
        return all;
    }
    // An empty array fits an array of anything.
    if (is_array(like) && is_array(value) && ValueView(value).count() == 0) return Value(like.type());
    return std::nullopt;
}

std::string headline(const ParameterSpec& spec) {
    return fmt::format("parameter '{}' ({})", spec.name, type_text(spec.initial));
}

// Calls `visit(element)` for the elements of an array until it returns false; any other value counts as its own single
// element.
template <class Visit>
void for_each_single(const Value& value, const Visit& visit) {
    is_array(value) ? for_each_element(ValueView(value), visit) : static_cast<void>(visit(ValueView(value)));
}

// Whether the choices of an array are choices of its elements.
bool chooses_elements(const ParameterSpec& spec) {
    return is_array(spec.initial) && !spec.choices.empty() && !is_array(spec.choices.front());
}

// A value with the type of the choices.
Value choice_like(const ParameterSpec& spec) {
    return chooses_elements(spec) ? Value(spec.initial.type().single()) : spec.initial;
}

// The declaration with which each of the choices is checked.
ParameterSpec choice_spec(const ParameterSpec& spec) {
    ParameterSpec bare = spec;
    bare.initial = choice_like(spec);
    if (chooses_elements(spec)) bare.min_size = bare.max_size = std::nullopt;
    bare.choices.clear();
    return bare;
}

// The error if this widget can't show such a parameter, or "".
std::string widget_broken(const ParameterSpec& spec) {
    if (spec.widget.empty() || spec.widget == "text") return "";
    const bool is_number = spec.initial.type().single().is_number();
    if (!contains(widgets, spec.widget)) {
        return fmt::format("there is no widget '{}'{}: expected one of {}", shown(spec.widget),
                           did_you_mean(spec.widget, {widgets.begin(), widgets.end()}), fmt::join(widgets, ", "));
    }
    std::string_view needs;
    if (spec.widget == "slider" && !(is_number && spec.min && spec.max)) needs = "numbers with min and max";
    if (spec.widget == "spin" && !is_number) needs = "numbers";
    if (spec.widget == "radio" && (spec.choices.empty() || is_array(spec.initial))) needs = "one value with choices";
    if (spec.widget == "checkbox" && !spec.initial.is<bool>() && !chooses_elements(spec))
        needs = "a boolean, or an array with choices of its elements";
    if (spec.widget == "ordered_list" && !chooses_elements(spec)) needs = "an array with choices of its elements";
    return needs.empty() ? "" : fmt::format("the widget '{}' is for {}", spec.widget, needs);
}

// The error if this number is not allowed, or "".
std::string bound_broken(const ParameterSpec& spec, const ValueView& number) {
    const auto value = visit_number(number, [](const auto& each) { return static_cast<double>(each); });
    if (!std::isfinite(value)) return fmt::format("{} is not a finite number", lua_text(number));
    const auto bound = [&](double limit) {
        const auto whole = number.type->is_integer() ? to_integer(limit) : std::nullopt;
        return whole ? std::to_string(*whole) : lua_number(limit);
    };
    if (spec.min && value < *spec.min)
        return fmt::format("{} is below its minimum {}", lua_text(number), bound(*spec.min));
    if (spec.max && value > *spec.max)
        return fmt::format("{} is above its maximum {}", lua_text(number), bound(*spec.max));
    return "";
}

// The error if the array may not have this number of elements, or "".
std::string size_broken(const ParameterSpec& spec, std::size_t size) {
    if (spec.min_size && size < *spec.min_size)
        return fmt::format("{} elements are fewer than its min_size {}", size, *spec.min_size);
    if (spec.max_size && size > *spec.max_size)
        return fmt::format("{} elements are more than its max_size {}", size, *spec.max_size);
    return "";
}

// The error if the value, which has the parameter's type, is outside of its bounds, or "".
std::string bounds_broken(const ParameterSpec& spec, const Value& value) {
    std::string why = is_array(value) ? size_broken(spec, ValueView(value).count()) : "";
    if (!why.empty() || !value.type().single().is_number()) return why;
    std::size_t place = 0;
    for_each_single(value, [&](const ValueView& number) {
        ++place;
        why = bound_broken(spec, number);
        return why.empty();
    });
    return why.empty() || !is_array(value) ? why : fmt::format("element {}: {}", place, why);
}

// The error if the value is not one of the choices, or "".
std::string choice_broken(const ParameterSpec& spec, const Value& value) {
    if (spec.choices.empty() || contains(spec.choices, value)) return "";
    std::string list;
    std::vector<std::string_view> texts;
    for (const Value& choice : spec.choices) {
        list += (list.empty() ? "" : ", ") + lua_text(choice);
        if (const auto* text = choice.get_if<std::string>()) texts.emplace_back(*text);
    }
    const auto* text = value.get_if<std::string>();
    return fmt::format("{} is not one of its choices {}{}", lua_text(value), list,
                       text != nullptr ? did_you_mean(*text, texts) : "");
}

}  // namespace

std::string type_text(const Value& value) {
    const Type& single = value.type().single();
    const std::string_view name = single.kind == Type::Kind::boolean ? "boolean"
                                  : single.is_integer()              ? "integer"
                                  : single.is_floating()             ? "number"
                                  : single.kind == Type::Kind::text  ? "string"
                                                                     : std::string_view(single.name);
    return is_array(value) ? fmt::format("array of {}s", name) : std::string(name);
}

Expected<Value> check_value(const ParameterSpec& spec, const Value& value) {
    auto converted = convert(spec.initial, value);
    std::string broken =
        !converted ? fmt::format("expected {}, got {} {}", type_text(spec.initial), type_text(value), lua_text(value))
                   : bounds_broken(spec, *converted);
    if (broken.empty() && chooses_elements(spec)) {
        for_each_single(*converted, [&](const ValueView& each) {
            broken = choice_broken(spec, Value(each));
            return broken.empty();
        });
    } else if (broken.empty()) {
        broken = choice_broken(spec, *converted);
    }
    if (!broken.empty()) return failure(headline(spec) + ": " + broken);
    return std::move(*converted);
}

Expected<void> check_declaration(const ParameterSpec& spec) {
    const auto refuse = [&](const std::string& why) { return failure(headline(spec) + ": " + why, spec.place); };
    for (const auto& bound : {spec.min, spec.max}) {
        if (bound && !std::isfinite(*bound)) return refuse("min and max must be finite");
    }
    if (!std::isfinite(spec.step) || spec.step < 0) return refuse("step must be a positive number");
    if (spec.min && spec.max && *spec.min > *spec.max) {
        return refuse(fmt::format("min {} is above max {}", lua_number(*spec.min), lua_number(*spec.max)));
    }
    if (spec.min_size && spec.max_size && *spec.min_size > *spec.max_size) {
        return refuse(fmt::format("min_size {} is above max_size {}", *spec.min_size, *spec.max_size));
    }
    if (const std::string broken = widget_broken(spec); !broken.empty()) return refuse(broken);
    const ParameterSpec bare = choice_spec(spec);
    for (const Value& choice : spec.choices) {
        if (const auto allowed = check_value(bare, choice); !allowed)
            return failure(allowed.error().message + ", in its choices", spec.place);
    }
    if (const auto allowed = check_value(spec, spec.initial); !allowed) {
        return failure(allowed.error().message + ", in its default", spec.place);
    }
    return {};
}

Expected<void> Parameters::declare(ParameterSpec spec) {
    if (find(spec.name) != nullptr)
        return failure(fmt::format("parameter '{}' is declared twice", spec.name), spec.place);
    const Value like = choice_like(spec);
    for (Value& choice : spec.choices) {
        if (auto same_type = convert(like, choice)) choice = std::move(*same_type);
    }
    if (auto ok = check_declaration(spec); !ok) return ok;
    all_.push_back({spec, spec.initial, false});
    ++version_;
    return {};
}

const Parameters::Parameter* Parameters::find(std::string_view name) const {
    const auto found = std::find_if(all_.begin(), all_.end(), [&](const Parameter& p) { return p.spec.name == name; });
    return found == all_.end() ? nullptr : &*found;
}

Expected<std::size_t> Parameters::index_of(std::string_view name) const {
    if (const Parameter* parameter = find(name)) return static_cast<std::size_t>(parameter - all_.data());
    const auto name_of = [](const Parameter& parameter) -> std::string_view { return parameter.spec.name; };
    return failure(fmt::format("unknown parameter '{}'{}", shown(name), did_you_mean(name, all_, name_of)));
}

Expected<void> Parameters::set(std::string_view name, const Value& value) {
    return stage(name, value, true).map([this] { take_staged(); });
}

Expected<void> Parameters::set_all(const ParameterValues& values) {
    const std::size_t before = staged_.size();
    for (const auto& [name, value] : values) {
        if (auto ok = stage(name, value, true); !ok) {
            staged_.resize(before);
            return ok;
        }
    }
    take_staged();
    return {};
}

void Parameters::follow_default(std::string_view name) {
    const auto index = index_of(name);
    if (!index) return;
    all_[*index].value = all_[*index].spec.initial;
    all_[*index].set = false;
    ++version_;
}

Expected<void> Parameters::stage(std::string_view name, const Value& value, bool from_outside) {
    const auto index = index_of(name);
    if (!index) return Unexpected(index.error());
    auto allowed = check_value(all_[*index].spec, value);
    if (!allowed) return Unexpected(allowed.error());
    staged_.push_back({*index, std::move(*allowed), from_outside});
    return {};
}

bool Parameters::take_staged() {
    if (staged_.empty()) return false;
    for (auto& [index, value, from_outside] : staged_) {
        all_[index].value = std::move(value);
        all_[index].set = true;
        all_[index].from_outside = from_outside;
        all_[index].from_within = !from_outside;
    }
    staged_.clear();
    ++version_;
    return true;
}

void Parameters::adopt(const Parameters& earlier) {
    for (const Parameter& parameter : all_) adopt(earlier, parameter.spec.name);
}

void Parameters::adopt_from_outside(const Parameters& earlier) {
    for (const Parameter& parameter : earlier.all_) {
        if (parameter.from_outside) adopt(earlier, parameter.spec.name);
    }
}

void Parameters::begin_version() {
    for (Parameter& parameter : all_) parameter.from_outside = parameter.from_within = false;
}

void Parameters::adopt(const Parameters& earlier, std::string_view name) {
    const auto index = index_of(name);
    const Parameter* before = earlier.find(name);
    if (!index || before == nullptr || !before->set) return;
    Parameter& parameter = all_[*index];
    if (&before->value.type() != &parameter.spec.initial.type()) return;
    auto allowed = check_value(parameter.spec, before->value);
    if (!allowed) return;
    parameter.value = std::move(*allowed);
    parameter.set = true;
    // If the value was set before the earlier version began, both flags are false there, and the present flags stay.
    if (before->from_outside || before->from_within) {
        parameter.from_outside = before->from_outside;
        parameter.from_within = before->from_within;
    }
    ++version_;
}

}  // namespace nezumi
