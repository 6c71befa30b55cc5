// The forms are those of OpenRTM-aist's tools: "slider.0.1", "-1.5<=x<=1.5", "x>3", "(low,high)".
#include "bindings/openrtm/peer_parameters.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "bindings/openrtm/profile_parameter.hpp"
#include "bindings/openrtm/rtc_profiles.hpp"
#include "engine/base/number_in.hpp"
#include "engine/base/trimmed.hpp"

namespace nezumi::openrtm {
namespace {

constexpr std::size_t most_choices = 100;

std::string_view text_in(const PeerSnapshot& peer, std::string_view set, std::string_view parameter) {
    for (const auto& [name, values] : peer.sets) {
        if (name != set) continue;
        for (const auto& [key, text] : values) {
            if (key == parameter) return text;
        }
    }
    return "";
}

std::optional<double> bound_in(std::string_view text) { return finite_in(trimmed(text)); }

struct Comparison {
    std::size_t at = 0, size = 0;  // of the operator in the text
    bool is_less = false, is_inclusive = false;
};

std::vector<Comparison> comparisons_in(std::string_view text) {
    std::vector<Comparison> all;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '<' && text[i] != '>') continue;
        const bool is_inclusive = i + 1 < text.size() && text[i + 1] == '=';
        all.push_back({i, is_inclusive ? std::size_t{2} : std::size_t{1}, text[i] == '<', is_inclusive});
    }
    return all;
}

// "0<=x<10": a number on either side of a comparison with x is a bound.
void read_bounds(std::string_view text, ParameterSpec& spec) {
    const bool is_whole = spec.initial.type().single().is_integer();
    const std::vector<Comparison> all = comparisons_in(text);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const std::size_t begin = i == 0 ? 0 : all[i - 1].at + all[i - 1].size;
        const std::size_t after = all[i].at + all[i].size;
        const std::size_t end = i + 1 < all.size() ? all[i + 1].at : text.size();
        const auto left = bound_in(text.substr(begin, all[i].at - begin));
        const auto right = bound_in(text.substr(after, end - after));
        if (left.has_value() == right.has_value()) continue;
        const bool is_lower = left.has_value() == all[i].is_less;
        double value = left ? *left : *right;
        if (!all[i].is_inclusive && is_whole) value = is_lower ? std::floor(value) + 1 : std::ceil(value) - 1;
        (is_lower ? spec.min : spec.max) = value;
    }
}

void read_choices(std::string_view text, ParameterSpec& spec) {
    const Value element(spec.initial.type().single());
    while (spec.choices.size() < most_choices) {
        const std::size_t comma = text.find(',');
        auto choice = from_rtc_text(std::string(trimmed(text.substr(0, comma))), element);
        if (!choice) {
            spec.choices.clear();
            return;
        }
        spec.choices.push_back(std::move(*choice));
        if (comma == std::string_view::npos) return;
        text.remove_prefix(comma + 1);
    }
}

void read_widget(std::string_view text, ParameterSpec& spec) {
    const std::size_t dot = std::min(text.find('.'), text.size());
    spec.widget = text.substr(0, dot);
    const auto step = bound_in(text.substr(std::min(dot + 1, text.size())));
    if (step && *step > 0) spec.step = *step;
}

}  // namespace

std::vector<PeerParameter> parameters_of(const PeerSnapshot& peer) {
    const auto in_use =
        std::find_if(peer.sets.begin(), peer.sets.end(), [&](const auto& set) { return set.first == peer.set; });
    std::vector<PeerParameter> all;
    if (in_use == peer.sets.end()) return all;
    for (const auto& [name, text] : in_use->second) {
        if (name.starts_with("__")) continue;
        PeerParameter parameter;
        ParameterSpec& spec = parameter.spec;
        spec.name = name;
        read_widget(text_in(peer, "__widget__", name), spec);
        const bool is_number = spec.widget == "slider" || spec.widget == "spin";
        const auto zero = zero_of_rtc_type(text_in(peer, "__type__", name));
        spec.initial = zero.value_or(is_number ? Value(0.0) : Value(std::string()));
        auto value = from_rtc_text(text, spec.initial);
        if (!value) spec.initial = Value(std::string());
        parameter.value = value ? std::move(*value) : Value(text);
        const std::string_view constraint = trimmed(text_in(peer, "__constraints__", name));
        if (constraint.starts_with('(') && constraint.ends_with(')')) {
            read_choices(constraint.substr(1, constraint.size() - 2), spec);
        } else if (!spec.initial.is<std::string>()) {
            read_bounds(constraint, spec);
        }
        all.push_back(std::move(parameter));
    }
    return all;
}

}  // namespace nezumi::openrtm
