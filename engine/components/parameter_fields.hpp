// The options of a parameter's declaration, with documentation and limits.
#pragma once

#include <limits>

#include "engine/components/parameter.hpp"
#include "engine/ports/setting.hpp"

namespace nezumi {

/// The widgets for parameters, with the names of OpenRTM.
inline constexpr std::array<std::string_view, 6> widgets{"slider", "spin", "radio", "checkbox", "ordered_list", "text"};

template <>
struct Describe<ParameterSpec> {
    static constexpr std::string_view name = "parameter_options";
    static constexpr std::string_view doc = "Options of a parameter. Limits are inclusive and apply to every change.";
    static constexpr std::array<std::string_view, 4> kinds{"numbers", "arrays of numbers", "other arrays",
                                                           "all others"};
    static constexpr double any = std::numeric_limits<double>::max();
    static constexpr unsigned numbers = 1U << 0U | 1U << 1U, arrays = 1U << 1U | 1U << 2U;
    static constexpr FieldList fields{
        Setting{"min",
                &ParameterSpec::min,
                "",
                "smallest value; of each element of an array",
                {.most = any, .of = numbers, .fallback = "none"}},
        Setting{"max",
                &ParameterSpec::max,
                "",
                "largest value; of each element of an array",
                {.most = any, .of = numbers, .fallback = "none"}},
        Setting{"step",
                &ParameterSpec::step,
                "",
                "step of the widget; other values are allowed too",
                {.range = NumberRange::positive, .most = any, .of = numbers, .fallback = "none"}},
        Setting{"widget",
                &ParameterSpec::widget,
                "",
                "the control that changes the value: a slider needs both bounds, radio needs choices; a checkbox "
                "shows a boolean, or an array as a part of its choices; an ordered list shows an array of its "
                "choices",
                {.choices = widgets}},
        Setting{"unit", &ParameterSpec::unit, "", "for example \"m/s\""},
        Setting{"doc", &ParameterSpec::doc, "", "what it means"},
        Extra{"choices", "ParameterValue[]", "", "the allowed values; if omitted: all within the bounds"},
        Setting{"min_size",
                &ParameterSpec::min_size,
                "",
                "smallest number of elements",
                {.max = 1'000'000, .of = arrays, .fallback = "none"}},
        Setting{"max_size",
                &ParameterSpec::max_size,
                "",
                "largest number of elements",
                {.max = 1'000'000, .of = arrays, .fallback = "none"}},
        Internal{&ParameterSpec::name},
        Internal{&ParameterSpec::initial},
        Internal{&ParameterSpec::choices},
        Internal{&ParameterSpec::place},
    };
};

}  // namespace nezumi
