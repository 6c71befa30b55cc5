// Checks of parameters' values and the messages that say what was wrong.
#include "engine/components/parameter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/lua_text.hpp"
#include "engine/components/parameter_fields.hpp"

namespace nezumi {
namespace {

template <class T>
struct IsVector : std::false_type {};
template <class T>
struct IsVector<std::vector<T>> : std::true_type {};

std::string element_text(bool value) { return value ? "true" : "false"; }
std::string element_text(std::int64_t value) { return std::to_string(value); }
std::string element_text(double value) { return lua_number(value); }
std::string element_text(const std::string& value) { return lua_quoted(value); }

// A whole number that a double holds exactly, as an integer; nothing otherwise.
std::optional<std::int64_t> to_integer(double value) {
    constexpr double limit = 9223372036854775808.0;  // 2^63
    if (!(value >= -limit && value < limit) || value != std::floor(value)) return std::nullopt;
    return static_cast<std::int64_t>(value);
}

// `value` as the alternative that `like` holds, where nothing is lost.
std::optional<ParameterValue> convert(const ParameterValue& like, const ParameterValue& value) {
    if (like.index() == value.index()) return value;
    if (std::holds_alternative<double>(like)) {
        if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
    } else if (std::holds_alternative<std::int64_t>(like)) {
        if (const auto* number = std::get_if<double>(&value)) {
            if (const auto whole = to_integer(*number)) return *whole;
        }
    } else if (std::holds_alternative<std::vector<double>>(like)) {
        if (const auto* whole = std::get_if<std::vector<std::int64_t>>(&value)) {
            return std::vector<double>(whole->begin(), whole->end());
        }
    } else if (std::holds_alternative<std::vector<std::int64_t>>(like)) {
        if (const auto* numbers = std::get_if<std::vector<double>>(&value)) {
            std::vector<std::int64_t> all;
            for (const double number : *numbers) {
                const auto whole = to_integer(number);
                if (!whole) return std::nullopt;
                all.push_back(*whole);
            }
            return all;
        }
    }
    // An empty array fits an array of anything.
    const auto size = [](const ParameterValue& v) {
        return std::visit(
            [](const auto& x) -> std::size_t {
                if constexpr (IsVector<std::decay_t<decltype(x)>>::value) {
                    return x.size();
                } else {
                    return 1;
                }
            },
            v);
    };
    if (size(value) == 0 && like.index() >= 4) {
        ParameterValue empty = like;
        std::visit(
            [](auto& x) {
                if constexpr (IsVector<std::decay_t<decltype(x)>>::value) x.clear();
            },
            empty);
        return empty;
    }
    return std::nullopt;
}

std::string headline(const ParameterSpec& spec) {
    return fmt::format("parameter '{}' ({})", spec.name, type_text(spec.initial));
}

// The elements of an array; any other value is its own only element.
std::vector<ParameterValue> elements_of(const ParameterValue& value) {
    return std::visit(
        [](const auto& v) {
            using T = std::decay_t<decltype(v)>;
            std::vector<ParameterValue> all;
            if constexpr (IsVector<T>::value) {
                for (std::size_t i = 0; i < v.size(); ++i) all.emplace_back(static_cast<typename T::value_type>(v[i]));
            } else {
                all.emplace_back(v);
            }
            return all;
        },
        value);
}

bool is_array(const ParameterValue& value) { return value.index() >= 4; }

// A value of the type that an array's elements have.
ParameterValue element_like(const ParameterValue& array) {
    switch (array.index() % 4) {
        case 0: return false;
        case 1: return std::int64_t{0};
        case 2: return 0.0;
        default: return std::string();
    }
}

// Whether the choices of an array are choices of its elements.
bool chooses_elements(const ParameterSpec& spec) {
    return is_array(spec.initial) && !spec.choices.empty() && !is_array(spec.choices.front());
}

// The choices' own declaration: what each of them must fit.
ParameterSpec choice_spec(const ParameterSpec& spec) {
    ParameterSpec bare = spec;
    if (chooses_elements(spec)) {
        bare.initial = element_like(spec.initial);
        bare.min_size = bare.max_size = std::nullopt;
    }
    bare.choices.clear();
    return bare;
}

// Why this widget can't show such a parameter, or "".
std::string widget_broken(const ParameterSpec& spec) {
    if (spec.widget.empty() || spec.widget == "text") return "";
    const bool is_number = spec.initial.index() % 4 == 1 || spec.initial.index() % 4 == 2;
    if (std::find(widgets.begin(), widgets.end(), spec.widget) == widgets.end()) {
        return fmt::format("there is no widget '{}'{}: expected one of {}", shown(spec.widget),
                           did_you_mean(spec.widget, {widgets.begin(), widgets.end()}), fmt::join(widgets, ", "));
    }
    std::string_view needs;
    if (spec.widget == "slider" && !(is_number && spec.min && spec.max)) needs = "numbers with min and max";
    if (spec.widget == "spin" && !is_number) needs = "numbers";
    if (spec.widget == "radio" && (spec.choices.empty() || is_array(spec.initial))) needs = "one value with choices";
    if (spec.widget == "checkbox" && spec.initial.index() != 0 && !chooses_elements(spec))
        needs = "a boolean, or an array with choices of its elements";
    if (spec.widget == "ordered_list" && !chooses_elements(spec)) needs = "an array with choices of its elements";
    return needs.empty() ? "" : fmt::format("the widget '{}' is for {}", spec.widget, needs);
}

// Why this number may not be, or "".
template <class Number>
std::string bound_broken(const ParameterSpec& spec, Number number) {
    const auto value = static_cast<double>(number);
    if (!std::isfinite(value)) return fmt::format("{} is not a finite number", element_text(number));
    const auto bound = [](double limit) {
        const auto whole = to_integer(limit);
        return std::is_same_v<Number, std::int64_t> && whole ? element_text(*whole) : element_text(limit);
    };
    if (spec.min && value < *spec.min)
        return fmt::format("{} is below its minimum {}", element_text(number), bound(*spec.min));
    if (spec.max && value > *spec.max)
        return fmt::format("{} is above its maximum {}", element_text(number), bound(*spec.max));
    return "";
}

}  // namespace

std::string to_text(const ParameterValue& value) {
    return std::visit(
        [](const auto& v) -> std::string {
            using T = std::decay_t<decltype(v)>;
            if constexpr (IsVector<T>::value) {
                if (v.empty()) return "{}";
                std::string text = "{ ";
                for (std::size_t i = 0; i < v.size(); ++i) {
                    if (i > 0) text += ", ";
                    text += element_text(static_cast<typename T::value_type>(v[i]));
                }
                return text + " }";
            } else {
                return element_text(v);
            }
        },
        value);
}

std::string_view type_text(const ParameterValue& value) {
    constexpr std::string_view names[] = {"boolean",          "integer",           "number",
                                          "string",           "array of booleans", "array of integers",
                                          "array of numbers", "array of strings"};
    return names[value.index()];
}

Expected<ParameterValue> check_value(const ParameterSpec& spec, const ParameterValue& value) {
    const auto refuse = [&](const std::string& why) { return failure(headline(spec) + ": " + why); };
    auto converted = convert(spec.initial, value);
    if (!converted)
        return refuse(fmt::format("expected {}, got {} {}", type_text(spec.initial), type_text(value), to_text(value)));

    const std::string broken = std::visit(
        [&](const auto& v) -> std::string {
            using T = std::decay_t<decltype(v)>;
            if constexpr (IsVector<T>::value) {
                if (spec.min_size && v.size() < *spec.min_size) {
                    return fmt::format("{} elements are fewer than its min_size {}", v.size(), *spec.min_size);
                }
                if (spec.max_size && v.size() > *spec.max_size) {
                    return fmt::format("{} elements are more than its max_size {}", v.size(), *spec.max_size);
                }
                if constexpr (std::is_same_v<T, std::vector<double>> || std::is_same_v<T, std::vector<std::int64_t>>) {
                    for (std::size_t i = 0; i < v.size(); ++i) {
                        const std::string why = bound_broken(spec, v[i]);
                        if (!why.empty()) return fmt::format("element {}: {}", i + 1, why);
                    }
                }
            } else if constexpr (std::is_same_v<T, double> || std::is_same_v<T, std::int64_t>) {
                return bound_broken(spec, v);
            }
            return "";
        },
        *converted);
    if (!broken.empty()) return refuse(broken);

    const std::vector<ParameterValue> chosen =
        chooses_elements(spec) ? elements_of(*converted) : std::vector{*converted};
    for (const ParameterValue& one : chosen) {
        if (spec.choices.empty() || std::find(spec.choices.begin(), spec.choices.end(), one) != spec.choices.end())
            continue;
        std::string list;
        std::vector<std::string_view> texts;
        for (const ParameterValue& choice : spec.choices) {
            list += (list.empty() ? "" : ", ") + to_text(choice);
            if (const auto* text = std::get_if<std::string>(&choice)) texts.emplace_back(*text);
        }
        const auto* text = std::get_if<std::string>(&one);
        return refuse(fmt::format("{} is none of its choices {}{}", to_text(one), list,
                                  text != nullptr ? did_you_mean(*text, texts) : ""));
    }
    return std::move(*converted);
}

Expected<void> check_declaration(const ParameterSpec& spec) {
    const auto refuse = [&](const std::string& why) { return failure(headline(spec) + ": " + why, spec.place); };
    for (const auto& bound : {spec.min, spec.max}) {
        if (bound && !std::isfinite(*bound)) return refuse("min and max must be finite");
    }
    if (!std::isfinite(spec.step) || spec.step < 0) return refuse("step must be a positive number");
    if (spec.min && spec.max && *spec.min > *spec.max) {
        return refuse(fmt::format("min {} is above max {}", element_text(*spec.min), element_text(*spec.max)));
    }
    if (spec.min_size && spec.max_size && *spec.min_size > *spec.max_size) {
        return refuse(fmt::format("min_size {} is above max_size {}", *spec.min_size, *spec.max_size));
    }
    if (const std::string broken = widget_broken(spec); !broken.empty()) return refuse(broken);
    const ParameterSpec bare = choice_spec(spec);
    for (const ParameterValue& choice : spec.choices) {
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
    const ParameterValue like = chooses_elements(spec) ? element_like(spec.initial) : spec.initial;
    for (ParameterValue& choice : spec.choices) {
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
    std::vector<std::string_view> names;
    for (const Parameter& parameter : all_) names.push_back(parameter.spec.name);
    return failure(fmt::format("unknown parameter '{}'{}", shown(name), did_you_mean(name, names)));
}

Expected<void> Parameters::set(std::string_view name, const ParameterValue& value) {
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

Expected<void> Parameters::stage(std::string_view name, const ParameterValue& value, bool from_outside) {
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
    if (before->value.index() != parameter.spec.initial.index()) return;
    auto allowed = check_value(parameter.spec, before->value);
    if (!allowed) return;
    parameter.value = std::move(*allowed);
    parameter.set = true;
    // What was set before that version began keeps what is known here of who did it.
    if (before->from_outside || before->from_within) {
        parameter.from_outside = before->from_outside;
        parameter.from_within = before->from_within;
    }
    ++version_;
}

}  // namespace nezumi
