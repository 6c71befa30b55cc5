// In a profile of OpenRTM, defaults are texts, and type names come from several programming languages. Properties with
// names "nezumi...." hold what OpenRTM does not define.
#include "bindings/openrtm/profile_parameter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <utility>

#include "bindings/openrtm/profile_constraint.hpp"
#include "bindings/openrtm/profile_xml.hpp"
#include "bindings/openrtm/rtc_profiles.hpp"
#include "engine/base/list.hpp"
#include "engine/base/trimmed.hpp"

namespace nezumi::openrtm {
namespace {

constexpr const char* widget_property = "__widget__";
constexpr const char* step_property = "nezumi.step";
constexpr const char* min_size_property = "nezumi.min_size";
constexpr const char* max_size_property = "nezumi.max_size";
constexpr const char* element_property =
    "nezumi.element";  // of an array of texts, where the default does not say where each ends
constexpr const char* whole_property = "nezumi.choices";  // "whole": of an array, not of its elements

bool has_part(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

// "std::vector<double>", "double[]" and "sequence<double>" are arrays of "double".
struct NamedType {
    std::string single;
    bool is_array = false;
};

NamedType named_type(std::string_view given) {
    NamedType type;
    for (const char c : given) {
        if (c != ' ') type.single += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    for (const std::string_view space : {"std::", "corba::", "rtc::"}) {
        for (std::size_t at = 0; (at = type.single.find(space)) != std::string::npos;)
            type.single.erase(at, space.size());
    }
    const std::size_t open = type.single.find('<');
    if (open != std::string::npos && type.single.ends_with('>')) {
        type = {type.single.substr(open + 1, type.single.size() - open - 2), true};
    } else if (type.single.ends_with("[]")) {
        type = {type.single.substr(0, type.single.size() - 2), true};
    }
    return type;
}

// A value of this type; nothing if RTCBuilder has such a type in none of its languages.
std::optional<Value> value_like(const NamedType& type) {
    const std::string_view name = type.single;
    constexpr std::array<std::string_view, 4> texts{"string", "str", "char", "wstring"};
    constexpr std::array<std::string_view, 3> numbers{"float", "double", "longdouble"};
    constexpr std::array<std::string_view, 2> booleans{"bool", "boolean"};
    if (contains(texts, name)) return type.is_array ? Value(std::vector<std::string>()) : Value(std::string());
    if (contains(numbers, name)) return type.is_array ? Value(std::vector<double>()) : Value(0.0);
    if (contains(booleans, name)) return type.is_array ? Value(std::vector<bool>()) : Value(false);
    if (has_part(name, "short") || has_part(name, "long") || has_part(name, "int") || has_part(name, "unsigned") ||
        name == "octet" || name == "byte") {
        return type.is_array ? Value(std::vector<std::int64_t>()) : Value(std::int64_t{0});
    }
    return std::nullopt;
}

// Reads a number in the notation of any of these languages: " +1.5f", "0x6A".
std::optional<double> foreign_number_in(std::string_view text) {
    text = trimmed(text);
    const bool is_negative = text.starts_with('-');
    if (is_negative || text.starts_with('+')) text.remove_prefix(1);
    double value = 0;
    std::from_chars_result read{};
    if (text.starts_with("0x") || text.starts_with("0X")) {
        std::uint32_t whole = 0;
        text.remove_prefix(2);
        read = std::from_chars(text.data(), text.data() + text.size(), whole, 16);
        value = whole;
    } else {
        read = std::from_chars(text.data(), text.data() + text.size(), value);
    }
    const std::string_view rest(read.ptr, static_cast<std::size_t>(text.data() + text.size() - read.ptr));
    if (read.ec != std::errc() || text.starts_with('-') || !std::isfinite(value)) return std::nullopt;
    if (!rest.empty() && rest != "f" && rest != "F" && rest != "L" && rest != "l" && rest != "u" && rest != "U")
        return std::nullopt;
    return is_negative ? -value : value;
}

// Reads one value of the type of `like`; nothing if the text is not such a value.
std::optional<Value> single_in(std::string_view text, const Value& like) {
    if (like.is<std::string>()) return Value(std::string(text));
    if (auto value = from_rtc_text(std::string(text), like)) {
        const auto* number = value->get_if<double>();
        return number == nullptr || std::isfinite(*number) ? value : std::nullopt;
    }
    if (like.is<bool>()) {
        std::string word(trimmed(text));
        std::transform(word.begin(), word.end(), word.begin(),
                       [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        return from_rtc_text(word == "yes" || word == "on" ? "1" : word == "no" || word == "off" ? "0" : word, like);
    }
    const auto number = foreign_number_in(text);
    if (!number) return std::nullopt;
    if (like.is<double>()) return Value(*number);
    if (*number != std::floor(*number) || std::abs(*number) >= 9007199254740992.0) return std::nullopt;
    return Value(static_cast<std::int64_t>(*number));
}

// Removes the quotes or braces around a default, which some profiles have.
std::string_view unwrapped(std::string_view text, std::string_view pairs) {
    const std::string_view whole = trimmed(text);
    for (std::size_t i = 0; i + 1 < pairs.size(); i += 2) {
        if (whole.size() >= 2 && whole.front() == pairs[i] && whole.back() == pairs[i + 1])
            return whole.substr(1, whole.size() - 2);
    }
    return text;
}

// Reads an array of elements between commas; nothing if an element is not a value.
std::optional<Value> array_in(std::string_view text, const Value& like) {
    const Value element(like.type().single());
    std::string written;
    std::string_view rest = trimmed(unwrapped(text, "{}[]()"));
    while (!rest.empty()) {
        const std::size_t comma = rest.find(',');
        const auto value = single_in(rest.substr(0, comma), element);
        if (!value) return std::nullopt;
        written += (written.empty() ? "" : ",") + to_rtc_text(*value);
        rest = comma == std::string_view::npos ? std::string_view() : rest.substr(comma + 1);
    }
    return from_rtc_text(written, like);
}

std::optional<Value> value_in(std::string_view text, const Value& like) {
    if (like.type().kind == Type::Kind::sequence) return array_in(text, like);
    return single_in(like.is<std::string>() ? unwrapped(text, "\"\"") : text, like);
}

std::size_t size_in(const std::string& text) {
    std::size_t size = 0;
    std::from_chars(text.data(), text.data() + text.size(), size);
    return size;
}

void read_properties(const pugi::xml_node& configuration, ParameterSpec& spec) {
    std::vector<std::string> elements;
    for (const auto& [name, value] : properties_of(configuration)) {
        if (name == widget_property) {
            const std::size_t dot = value.find('.');
            spec.widget = value.substr(0, dot);
            const auto step = dot == std::string::npos ? std::nullopt : foreign_number_in(value.substr(dot + 1));
            if (step && *step > 0) spec.step = *step;
        } else if (name == step_property) {
            spec.step = foreign_number_in(value).value_or(0);
        } else if (name == min_size_property) {
            spec.min_size = size_in(value);
        } else if (name == max_size_property) {
            spec.max_size = size_in(value);
        } else if (name == element_property) {
            elements.push_back(value);
        }
    }
    if (!elements.empty() && spec.initial.is<std::vector<std::string>>()) spec.initial = Value(std::move(elements));
}

// Removes what makes the declaration invalid: the widget; or else the bounds and choices; or else both.
void keep_valid(ParameterSpec& spec, std::vector<std::string>& remarks) {
    const auto valid = check_declaration(spec);
    if (valid) return;
    remarks.push_back(valid.error().message);
    ParameterSpec without_widget = spec;
    without_widget.widget.clear();
    if (check_declaration(without_widget)) {
        spec = std::move(without_widget);
        return;
    }
    spec.min = spec.max = std::nullopt;
    spec.min_size = spec.max_size = std::nullopt;
    spec.step = 0;
    spec.choices.clear();
    if (!check_declaration(spec)) spec.widget.clear();
}

}  // namespace

std::optional<Value> zero_of_rtc_type(std::string_view name) { return value_like(named_type(name)); }

std::optional<ParameterSpec> read_parameter(const pugi::xml_node& configuration, std::vector<std::string>& remarks) {
    ParameterSpec spec;
    spec.name = attribute_of(configuration, "name");
    const auto remark = [&](const std::string& what) {
        remarks.push_back(fmt::format("parameter '{}': {}", shown(spec.name), what));
    };
    const std::string_view type_name = attribute_of(configuration, "type");
    const std::string_view text = attribute_of(configuration, "defaultValue");
    const auto like = zero_of_rtc_type(type_name);
    if (!like) remark(fmt::format("its type '{}' is unknown, so it becomes a string", shown(type_name)));
    spec.initial = like.value_or(Value(std::string()));
    if (auto value = value_in(text, spec.initial)) {
        spec.initial = std::move(*value);
    } else {
        remark(fmt::format("its default '{}' is not a {}: {} is used", shown(text), shown(type_name),
                           to_rtc_text(spec.initial)));
    }

    const pugi::xml_node doc = element_of(configuration, "Doc");
    spec.unit = attribute_of(configuration, "unit");
    if (spec.unit.empty()) spec.unit = attribute_of(doc, "unit");
    spec.doc = without_html_breaks(attribute_of(doc, "description"), " ");
    if (const std::string_view range = attribute_of(doc, "range"); !range.empty())
        spec.doc += fmt::format("{}range: {}", spec.doc.empty() ? "" : "; ", range);
    read_properties(configuration, spec);
    if (spec.initial.type().kind == Type::Kind::sequence && ValueView(spec.initial).count() == 0) {
        remark(fmt::format("its default is an empty array of '{}', so the type of its elements is unknown",
                           shown(type_name)));
        return std::nullopt;
    }

    const Value element(spec.initial.type().single());
    ProfileConstraint constraint = read_constraint(element_of(configuration, "Constraint"), element.is<std::int64_t>());
    for (const std::string& each : constraint.remarks) remark(each);
    spec.min = constraint.min;
    spec.max = constraint.max;
    const auto properties = properties_of(configuration);
    const bool is_whole = std::any_of(properties.begin(), properties.end(),
                                      [](const auto& property) { return property.name == whole_property; });
    for (const std::string& choice : constraint.choices) {
        if (auto value = value_in(choice, is_whole ? spec.initial : element)) {
            spec.choices.push_back(std::move(*value));
        } else {
            remark(fmt::format("the choice '{}' is not a {}", shown(choice), shown(type_name)));
        }
    }
    keep_valid(spec, remarks);
    return spec;
}

std::string profile_text(const Value& value) {
    std::string text = to_rtc_text(value);
    const bool has_quotes = value.is<std::string>() && unwrapped(text, "\"\"").size() != text.size();
    return has_quotes ? "\"" + text + "\"" : text;
}

void add_property(pugi::xml_node element, const char* name, const std::string& value) {
    pugi::xml_node property = element.append_child("rtcExt:Properties");
    property.append_attribute("rtcExt:name") = name;
    property.append_attribute("rtcExt:value") = value.c_str();
}

void write_parameter(const ParameterSpec& spec, pugi::xml_node configuration_set) {
    pugi::xml_node node = configuration_set.append_child("rtc:Configuration");
    const std::string type = rtc_type_of(spec.initial);
    const std::string text = profile_text(spec.initial);
    node.append_attribute("xsi:type") = "rtcExt:configuration_ext";
    node.append_attribute("rtc:name") = spec.name.c_str();
    node.append_attribute("rtc:type") = (type.starts_with("vector") ? "std::" + type : type).c_str();
    node.append_attribute("rtc:defaultValue") = text.c_str();
    node.append_attribute("rtc:unit") = spec.unit.c_str();
    node.append_attribute("rtcExt:variableName") = spec.name.c_str();
    write_constraint(spec, node);
    pugi::xml_node doc = node.append_child("rtcDoc:Doc");
    doc.append_attribute("rtcDoc:description") = spec.doc.c_str();
    doc.append_attribute("rtcDoc:unit") = spec.unit.c_str();
    if (!spec.widget.empty()) add_property(node, widget_property, rtc_widget_of(spec));
    if (spec.step > 0 && spec.widget != "slider" && spec.widget != "spin")
        add_property(node, step_property, fmt::format("{}", spec.step));
    if (spec.min_size) add_property(node, min_size_property, std::to_string(*spec.min_size));
    if (spec.max_size) add_property(node, max_size_property, std::to_string(*spec.max_size));
    if (!spec.choices.empty() && spec.choices.front().type().kind == Type::Kind::sequence)
        add_property(node, whole_property, "whole");
    const auto* texts = spec.initial.get_if<std::vector<std::string>>();
    if (texts != nullptr && value_in(text, spec.initial) != spec.initial) {
        for (const std::string& each : *texts) add_property(node, element_property, each);
    }
}

}  // namespace nezumi::openrtm
