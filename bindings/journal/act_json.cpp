// One writer and one reader for everything that describes itself, and for the few things that don't.
#include "bindings/journal/act_json.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <type_traits>
#include <utility>

#include "bindings/journal/plain_json.hpp"
#include "engine/ports/payload.hpp"
#include "engine/ports/port.hpp"

namespace nezumi {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};

// Each kind of array has its name: an empty one must keep its type.
template <class T>
constexpr std::string_view array_name() {
    if constexpr (std::is_same_v<T, std::vector<bool>>) return "booleans";
    if constexpr (std::is_same_v<T, std::vector<std::int64_t>>) return "integers";
    if constexpr (std::is_same_v<T, std::vector<double>>) return "numbers";
    return "texts";
}

// Writing.

Json write_parameter(const ParameterValue& value, const ScriptHost& scripts);
Json write_entry(const Entry& entry, const ScriptHost& scripts);
Json write_marker(const MarkerSpec& marker, const ScriptHost& scripts);

template <class T>
Json write(const T& value, const ScriptHost& scripts) {
    if constexpr (std::is_same_v<T, Entry>) {
        return write_entry(value, scripts);
    } else if constexpr (std::is_same_v<T, MarkerSpec>) {
        return write_marker(value, scripts);
    } else if constexpr (std::is_same_v<T, AnyPayload>) {
        return Json{{message_type_names[value.index()],
                     std::visit([&](const auto& each) { return write(each, scripts); }, value)}};
    } else if constexpr (std::is_same_v<T, ParameterValue>) {
        return write_parameter(value, scripts);
    } else if constexpr (std::is_same_v<T, PlainData>) {
        return plain_to_json(value);
    } else if constexpr (Described<T>) {
        Json fields = Json::object();
        for_each_field(value, [&](const auto& field, const auto& member) {
            if constexpr (IsOptional<std::remove_cvref_t<decltype(member)>>::value) {
                if (member) fields[std::string(field.name)] = write(*member, scripts);
            } else {
                fields[std::string(field.name)] = write(member, scripts);
            }
        });
        return fields;
    } else if constexpr (std::is_same_v<T, Octets>) {
        return text_to_json(std::string(value.begin(), value.end()));
    } else if constexpr (Sequence<T>) {
        Json elements = Json::array();
        for (const auto& element : value)
            elements.push_back(write(static_cast<typename T::value_type>(element), scripts));
        return elements;
    } else if constexpr (std::is_same_v<T, std::string>) {
        return text_to_json(value);
    } else if constexpr (std::is_floating_point_v<T>) {
        return number_to_json(static_cast<double>(value));
    } else {
        return value;
    }
}

Json write_parameter(const ParameterValue& value, const ScriptHost& scripts) {
    return std::visit(
        [&]<class T>(const T& each) -> Json {
            if constexpr (Sequence<T>)
                return Json{{array_name<T>(), write(each, scripts)}};
            else
                return write(each, scripts);
        },
        value);
}

// As a system file says it, and the file that names are looked up beside.
Json write_entry(const Entry& entry, const ScriptHost& scripts) {
    SystemSpec spec;
    spec.entries.push_back(entry);
    return Json{{"lua", text_to_json(scripts.write_system_text(spec, "An entry."))},
                {"file", text_to_json(place_of(entry).file)}};
}

// The same.
Json write_marker(const MarkerSpec& marker, const ScriptHost& scripts) {
    SystemSpec spec;
    spec.arena.markers.push_back(marker);
    return Json{{"lua", text_to_json(scripts.write_system_text(spec, "A marker."))},
                {"file", text_to_json(marker.place.file)}};
}

// Reading. Each returns what is wrong, "" for nothing.

template <class T>
std::string read(const Json& json, T& out, const PartReader& parts);

template <class T>
bool read_array(const Json& json, ParameterValue& out, const PartReader& parts, std::string& wrong) {
    const auto found = json.find(array_name<T>());
    if (found == json.end()) return false;
    wrong = read(*found, out.emplace<T>(), parts);
    return true;
}

std::string read_parameter(const Json& json, ParameterValue& out, const PartReader& parts) {
    std::string wrong;
    if (json.is_boolean()) return read(json, out.emplace<bool>(), parts);
    if (json.is_number_integer()) return read(json, out.emplace<std::int64_t>(), parts);
    if (json.is_number()) return read(json, out.emplace<double>(), parts);
    if (json.is_object() && (read_array<std::vector<bool>>(json, out, parts, wrong) ||
                             read_array<std::vector<std::int64_t>>(json, out, parts, wrong) ||
                             read_array<std::vector<double>>(json, out, parts, wrong) ||
                             read_array<std::vector<std::string>>(json, out, parts, wrong)))
        return wrong;
    if (json.is_object() && json.contains("number")) return read(json, out.emplace<double>(), parts);
    return read(json, out.emplace<std::string>(), parts);
}

std::string read_payload(const Json& json, AnyPayload& out, const PartReader& parts) {
    if (!json.is_object() || json.size() != 1) return expected_in_json("a message by its type's name", json);
    const auto type = find_message_type(json.begin().key());
    if (!type) return type.error().message;
    std::string wrong;
    const auto read_as = [&]<std::size_t index>() {
        if (index != *type) return;
        wrong = read(json.begin().value(), out.emplace<index>(), parts);
    };
    [&]<std::size_t... index>(std::index_sequence<index...>) { (read_as.template operator()<index>(), ...); }
    (std::make_index_sequence<std::variant_size_v<AnyPayload>>());
    return wrong;
}

// A part of a system, as `write_entry` and `write_marker` have written it; `part` gives what there is of its kind.
template <class T, class Part>
std::string read_part(const Json& json, T& out, const PartReader& parts, std::string_view what, const Part& part) {
    if (!json.is_object() || !json.contains("lua") || !json.contains("file"))
        return expected_in_json(fmt::format("{}'s lua and file", what), json);
    const auto text = text_from_json(json["lua"]);
    if (!text) return text.error().message;
    const auto file = text_from_json(json["file"]);
    if (!file) return file.error().message;
    auto spec = parts.read(*text, *file);
    if (!spec) return describe(spec.error());
    auto& all = part(*spec);
    if (all.size() != 1) return fmt::format("expected {}, got {}", what, all.size());
    out = std::move(all.front());
    return "";
}

template <class T>
std::string read_fields(const Json& json, T& out, const PartReader& parts) {
    if (!json.is_object()) return expected_in_json("fields", json);
    std::string wrong;
    std::size_t known = 0;
    for_each_field(out, [&](const auto& field, auto& member) {
        const auto found = json.find(std::string(field.name));
        if (found == json.end()) {
            if constexpr (!IsOptional<std::remove_cvref_t<decltype(member)>>::value) {
                if (wrong.empty()) wrong = fmt::format("'{}' is missing", field.name);
            }
            return;
        }
        ++known;
        std::string inner;
        if constexpr (IsOptional<std::remove_cvref_t<decltype(member)>>::value) {
            inner = read(*found, member.emplace(), parts);
        } else {
            inner = read(*found, member, parts);
        }
        if (!inner.empty() && wrong.empty()) wrong = fmt::format("'{}': {}", field.name, inner);
    });
    if (wrong.empty() && known != json.size()) wrong = "there is a field that it does not have";
    return wrong;
}

template <class T>
std::string read(const Json& json, T& out, const PartReader& parts) {
    if constexpr (std::is_same_v<T, Entry>) {
        return read_part(
            json, out, parts, "an entry", [](SystemSpec & spec) -> auto& { return spec.entries; });
    } else if constexpr (std::is_same_v<T, MarkerSpec>) {
        return read_part(
            json, out, parts, "a marker", [](SystemSpec & spec) -> auto& { return spec.arena.markers; });
    } else if constexpr (std::is_same_v<T, AnyPayload>) {
        return read_payload(json, out, parts);
    } else if constexpr (std::is_same_v<T, ParameterValue>) {
        return read_parameter(json, out, parts);
    } else if constexpr (std::is_same_v<T, PlainData>) {
        return read_plain(json, out);
    } else if constexpr (Described<T>) {
        return read_fields(json, out, parts);
    } else if constexpr (std::is_same_v<T, Octets>) {
        auto bytes = text_from_json(json);
        if (!bytes) return bytes.error().message;
        out.assign(bytes->begin(), bytes->end());
        return "";
    } else if constexpr (Sequence<T>) {
        if (!json.is_array()) return expected_in_json("a list", json);
        for (const Json& element : json) {
            typename T::value_type value{};
            if (std::string wrong = read(element, value, parts); !wrong.empty()) return wrong;
            out.push_back(std::move(value));
        }
        return "";
    } else if constexpr (std::is_same_v<T, std::string>) {
        auto text = text_from_json(json);
        if (!text) return text.error().message;
        out = std::move(*text);
        return "";
    } else if constexpr (std::is_same_v<T, bool>) {
        if (!json.is_boolean()) return expected_in_json("true or false", json);
        out = json.get<bool>();
        return "";
    } else if constexpr (std::is_floating_point_v<T>) {
        double value = 0;
        std::string wrong = read_number(json, value);
        out = static_cast<T>(value);
        return wrong;
    } else {
        if (!json.is_number_integer() ||
            static_cast<std::int64_t>(static_cast<T>(json.get<std::int64_t>())) != json.get<std::int64_t>())
            return expected_in_json("a whole number of its range", json);
        out = static_cast<T>(json.get<std::int64_t>());
        return "";
    }
}

// The act of this name, as it is when nothing is said; nothing when there is none.
template <std::size_t index = 0>
std::optional<Act> empty_act(std::string_view name) {
    if constexpr (index == std::variant_size_v<Act>) {
        return std::nullopt;
    } else {
        using Kind = std::variant_alternative_t<index, Act>;
        return Describe<Kind>::name == name ? std::optional<Act>(Kind{}) : empty_act<index + 1>(name);
    }
}

}  // namespace

Json to_json(const Act& act, const ScriptHost& scripts) {
    return std::visit([&](const auto& each) { return write(each, scripts); }, act);
}

Expected<Act> act_from_json(std::string_view name, const Json& fields, const PartReader& parts) {
    std::optional<Act> act = empty_act(name);
    if (!act) return failure(fmt::format("there is no act '{}'", shown(name)));
    const std::string wrong = std::visit([&](auto& each) { return read(fields, each, parts); }, *act);
    if (!wrong.empty()) return failure(fmt::format("{}: {}", name, wrong));
    return std::move(*act);
}

}  // namespace nezumi
