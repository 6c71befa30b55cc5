// One writer and one reader for everything that describes itself, and for the few things that don't.
#include "bindings/journal/act_json.hpp"

#include <fmt/format.h>

#include <cassert>
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

Json write(const ValueView& value, const ScriptHost& scripts);

// What describes itself to nobody has a form of its own.
Json write_other(const ValueView& value, const ScriptHost& scripts) {
    if (value.type == &type_of<Entry>()) return write_entry(value.as<Entry>(), scripts);
    if (value.type == &type_of<MarkerSpec>()) return write_marker(value.as<MarkerSpec>(), scripts);
    if (value.type == &type_of<ParameterValue>()) return write_parameter(value.as<ParameterValue>(), scripts);
    if (value.type == &type_of<PlainData>()) return plain_to_json(value.as<PlainData>());
    assert(value.type == &type_of<Value>());
    const auto& payload = value.as<Value>();
    return Json{{message_type_names[message_index(payload.type())], write(payload, scripts)}};
}

Json write(const ValueView& value, const ScriptHost& scripts) {
    switch (value.type->kind) {
        case Type::Kind::structure: {
            Json fields = Json::object();
            for (const Type::Field& field : value.type->fields) {
                const ValueView member = value.field(field);
                if (field.type->kind != Type::Kind::optional || member.count() > 0)
                    fields[field.name] = write(member, scripts);
            }
            return fields;
        }
        case Type::Kind::optional: return write({*value.type->element, value.first()}, scripts);
        case Type::Kind::array:
        case Type::Kind::sequence: {
            Json elements = Json::array();
            for_each_element(value, [&](const ValueView& element) {
                elements.push_back(write(element, scripts));
                return true;
            });
            return elements;
        }
        case Type::Kind::octets: {
            const auto& octets = value.as<Octets>();
            return text_to_json(std::string(octets.begin(), octets.end()));
        }
        case Type::Kind::text: return text_to_json(value.as<std::string>());
        case Type::Kind::other: return write_other(value, scripts);
        default:
            return visit_number(value, []<class T>(const T& number) -> Json {
                if constexpr (std::is_floating_point_v<T>) return number_to_json(static_cast<double>(number));
                return number;
            });
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

std::string read(const Json& json, const ValuePlace& out, const PartReader& parts);

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

std::string read_payload(const Json& json, Value& out, const PartReader& parts) {
    if (!json.is_object() || json.size() != 1) return expected_in_json("a message by its type's name", json);
    const auto type = find_message_type(json.begin().key());
    if (!type) return type.error().message;
    out = make_payload(*type);
    return read(json.begin().value(), out, parts);
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

std::string read_fields(const Json& json, const ValuePlace& out, const PartReader& parts) {
    if (!json.is_object()) return expected_in_json("fields", json);
    std::size_t known = 0;
    for (const Type::Field& field : out.type->fields) {
        const auto found = json.find(field.name);
        if (found == json.end()) {
            if (field.type->kind == Type::Kind::optional) continue;
            return fmt::format("'{}' is missing", field.name);
        }
        ++known;
        const std::string wrong = read(*found, out.field(field), parts);
        if (!wrong.empty()) return fmt::format("'{}': {}", field.name, wrong);
    }
    return known == json.size() ? "" : "there is a field that it does not have";
}

std::string read_sequence(const Json& json, const ValuePlace& out, const PartReader& parts) {
    if (!json.is_array()) return expected_in_json("a list", json);
    out.resize(json.size());
    std::string wrong;
    auto each = json.begin();
    for_each_element(out, [&](const ValuePlace& element) {
        wrong = read(*each++, element, parts);
        return wrong.empty();
    });
    return wrong;
}

std::string read_other(const Json& json, const ValuePlace& out, const PartReader& parts) {
    if (out.type == &type_of<Entry>()) {
        return read_part(
            json, out.as<Entry>(), parts, "an entry", [](SystemSpec & spec) -> auto& { return spec.entries; });
    }
    if (out.type == &type_of<MarkerSpec>()) {
        return read_part(
            json, out.as<MarkerSpec>(), parts, "a marker",
            [](SystemSpec & spec) -> auto& { return spec.arena.markers; });
    }
    if (out.type == &type_of<ParameterValue>()) return read_parameter(json, out.as<ParameterValue>(), parts);
    if (out.type == &type_of<PlainData>()) return read_plain(json, out.as<PlainData>());
    assert(out.type == &type_of<Value>());
    return read_payload(json, out.as<Value>(), parts);
}

std::string read(const Json& json, const ValuePlace& out, const PartReader& parts) {
    switch (out.type->kind) {
        case Type::Kind::structure: return read_fields(json, out, parts);
        case Type::Kind::optional: out.resize(1); return read(json, {*out.type->element, out.first()}, parts);
        case Type::Kind::sequence: return read_sequence(json, out, parts);
        case Type::Kind::octets: {
            auto bytes = text_from_json(json);
            if (!bytes) return bytes.error().message;
            out.as<Octets>().assign(bytes->begin(), bytes->end());
            return "";
        }
        case Type::Kind::text: {
            auto text = text_from_json(json);
            if (!text) return text.error().message;
            out.as<std::string>() = std::move(*text);
            return "";
        }
        case Type::Kind::boolean:
            if (!json.is_boolean()) return expected_in_json("true or false", json);
            out.as<bool>() = json.get<bool>();
            return "";
        case Type::Kind::other: return read_other(json, out, parts);
        default:
            return visit_number(out, [&]<class T>(T& number) -> std::string {
                if constexpr (std::is_floating_point_v<T>) {
                    double value = 0;
                    std::string wrong = read_number(json, value);
                    number = static_cast<T>(value);
                    return wrong;
                } else {
                    if (!json.is_number_integer() ||
                        static_cast<std::int64_t>(static_cast<T>(json.get<std::int64_t>())) != json.get<std::int64_t>())
                        return expected_in_json("a whole number of its range", json);
                    number = static_cast<T>(json.get<std::int64_t>());
                    return "";
                }
            });
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
