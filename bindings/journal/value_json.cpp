// JSON has no bytes and no NaN or infinity: these become objects.
#include "bindings/journal/value_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <type_traits>
#include <utility>

#include "bindings/journal/base64.hpp"
#include "engine/base/number_in.hpp"
#include "engine/base/utf8.hpp"
#include "engine/ports/payload.hpp"
#include "engine/ports/port.hpp"

namespace nezumi {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view base64_key = "base64:";

// The type with this name in JSON; nullptr if there is none.
const Type* find_type(const std::string& name, const OtherForms& others) {
    for (const PlainType& each : plain_types()) {
        if (each.name == name) return each.type;
    }
    const auto message = find_message_type(name);
    if (message) return (*message)->payload;
    const MessageType* defined = others.message ? others.message(name) : nullptr;
    return defined != nullptr ? defined->payload : nullptr;
}

Json write_any(const Value& value, const OtherForms& others) {
    if (const auto* table = value.get_if<TableRef>()) return Json{{"table", table->index}};
    // Always a number, even a large one: a string would be read back as a text.
    if (const auto* whole = value.get_if<std::int64_t>()) return *whole;
    for (const PlainType& each : plain_types()) {
        if (each.type != &value.type()) continue;
        Json json = value_to_json(value, others);
        return value.type().is_single() ? json : Json{{each.name, std::move(json)}};
    }
    return Json{{message_name(value.type()), value_to_json(value, others)}};
}

std::string read_any(const Json& json, Value& out, const OtherForms& others) {
    const auto read_as = [&](const Type& type, const Json& from) {
        out = Value(type);
        return read_value(from, out, others);
    };
    if (json.is_null()) return out = Value(), "";
    if (json.is_boolean()) return read_as(type_of<bool>(), json);
    if (json.is_number_integer()) return read_as(type_of<std::int64_t>(), json);
    if (json.is_number() || (json.is_object() && json.contains("number"))) return read_as(type_of<double>(), json);
    if (json.is_string() || (json.is_object() && json.contains("base64"))) return read_as(type_of<std::string>(), json);
    if (!json.is_object() || json.size() != 1) return expected_in_json("a value, or { TYPE: value }", json);
    const std::string& name = json.begin().key();
    const Json& held = json.begin().value();
    if (name == "table") {
        if (!held.is_number_unsigned()) return expected_in_json("a table's number", held);
        return out = TableRef{held.get<std::uint64_t>()}, "";
    }
    const Type* type = find_type(name, others);
    return type != nullptr ? read_as(*type, held) : find_message_type(name).error().message;
}

std::string read_fields(const Json& json, const ValuePlace& out, const OtherForms& others) {
    if (!json.is_object()) return expected_in_json("fields", json);
    std::size_t known = 0;
    for (const Type::Field& field : out.type->fields) {
        const auto found = json.find(field.name);
        if (found == json.end()) {
            if (field.type->kind == Type::Kind::optional) continue;
            return fmt::format("'{}' is missing", field.name);
        }
        ++known;
        const std::string wrong = read_value(*found, out.field(field), others);
        if (!wrong.empty()) return fmt::format("'{}': {}", field.name, wrong);
    }
    if (known != json.size()) return "it has an unknown field";
    const bool is_plain = out.type == &type_of<PlainData>();
    return !is_plain || is_sound(out.as<PlainData>()) ? "" : "a table is missing, or a key is wrong";
}

std::string read_elements(const Json& json, const ValuePlace& out, const OtherForms& others) {
    if (!json.is_array()) return expected_in_json("a list", json);
    if (out.type->kind == Type::Kind::sequence) out.resize(json.size());
    if (out.count() != json.size()) return expected_in_json(fmt::format("a list of {}", out.count()), json);
    std::string wrong;
    auto each = json.begin();
    for_each_element(out, [&](const ValuePlace& element) {
        wrong = read_value(*each++, element, others);
        return wrong.empty();
    });
    return wrong;
}

// Other programs read numbers of JSON as doubles, which hold whole numbers up to 2^53 exactly. Larger ones are texts.
template <class T>
Json write_whole(const T& number) {
    if constexpr (std::is_same_v<T, bool>) {
        return number;
    } else {
        constexpr std::int64_t most = std::int64_t{1} << 53;
        if (std::cmp_less_equal(number, most) && std::cmp_greater_equal(number, -most)) return number;
        return std::to_string(number);
    }
}

template <class T>
std::string read_whole(const Json& json, T& out) {
    if constexpr (!std::is_same_v<T, bool>) {
        if (const auto* text = json.get_ptr<const std::string*>()) {
            if (const auto read = number_in<T>(*text)) return out = *read, "";
        }
    }
    constexpr auto largest = std::uint64_t{std::numeric_limits<T>::max()};
    if (json.is_number_unsigned() ? json.get<std::uint64_t>() > largest
                                  : !json.is_number_integer() || !std::is_signed_v<T> ||
                                        json.get<std::int64_t>() < std::int64_t{std::numeric_limits<T>::min()})
        return expected_in_json("a whole number of its range", json);
    out = json.get<T>();
    return "";
}

}  // namespace

std::string expected_in_json(std::string_view what, const Json& got) {
    std::string text = got.dump(-1, ' ', true, Json::error_handler_t::replace);
    constexpr std::size_t most = 40;
    if (text.size() > most) {
        text.resize(most);
        text += "...";
    }
    return fmt::format("expected {}, got {}", what, text);
}

Json text_to_json(const std::string& text) {
    if (is_utf8(text)) return text;
    return Json{{"base64", to_base64(text)}};
}

Expected<std::string> text_from_json(const Json& json) {
    if (json.is_string()) return json.get<std::string>();
    const auto bytes = json.is_object() ? json.find("base64") : json.end();
    if (json.is_object() && bytes != json.end() && bytes->is_string()) {
        if (auto text = from_base64(bytes->get_ref<const std::string&>())) return std::move(*text);
    }
    return failure(expected_in_json("a string", json));
}

std::string text_to_key(const std::string& text) {
    return is_utf8(text) && !text.starts_with(base64_key) ? text : std::string(base64_key) + to_base64(text);
}

Expected<std::string> text_from_key(const std::string& key) {
    if (!key.starts_with(base64_key)) return key;
    auto text = from_base64(std::string_view(key).substr(base64_key.size()));
    if (!text) return failure(expected_in_json("a string", key));
    return std::move(*text);
}

Json number_to_json(double value) {
    if (std::isfinite(value)) return value;
    return Json{{"number", std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf"}};
}

std::string read_number(const Json& json, double& out) {
    if (json.is_number()) {
        out = json.get<double>();
        return "";
    }
    const auto word = json.is_object() ? json.find("number") : json.end();
    if (json.is_object() && word != json.end() && word->is_string()) {
        for (const auto& [name, value] : {std::pair{"nan", NAN}, {"inf", INFINITY}, {"-inf", -INFINITY}}) {
            if (*word != name) continue;
            out = value;
            return "";
        }
    }
    return expected_in_json("a number", json);
}

Json value_to_json(const ValueView& value, const OtherForms& others) {
    switch (value.type->kind) {
        case Type::Kind::nothing: return nullptr;
        case Type::Kind::structure: {
            Json fields = Json::object();
            for (const Type::Field& field : value.type->fields) {
                const ValueView member = value.field(field);
                if (field.type->kind != Type::Kind::optional || member.count() > 0)
                    fields[field.name] = value_to_json(member, others);
            }
            return fields;
        }
        case Type::Kind::optional: return value_to_json({*value.type->element, value.first()}, others);
        case Type::Kind::array:
        case Type::Kind::sequence: {
            Json elements = Json::array();
            for_each_element(value, [&](const ValueView& element) {
                elements.push_back(value_to_json(element, others));
                return true;
            });
            return elements;
        }
        case Type::Kind::octets: {
            const auto& octets = value.as<Octets>();
            return text_to_json(std::string(octets.begin(), octets.end()));
        }
        case Type::Kind::text: return text_to_json(value.as<std::string>());
        case Type::Kind::enumeration: return value.type->choices[value.choice()];
        case Type::Kind::any: return write_any(value.as<Value>(), others);
        case Type::Kind::other: return others.write(value);
        default:
            return visit_number(value, []<class T>(const T& number) -> Json {
                if constexpr (std::is_floating_point_v<T>) {
                    return number_to_json(static_cast<double>(number));
                } else {
                    return write_whole(number);
                }
            });
    }
}

std::string read_value(const Json& json, const ValuePlace& out, const OtherForms& others) {
    switch (out.type->kind) {
        case Type::Kind::nothing: return json.is_null() ? "" : expected_in_json("nothing", json);
        case Type::Kind::structure: return read_fields(json, out, others);
        case Type::Kind::optional: out.resize(1); return read_value(json, {*out.type->element, out.first()}, others);
        case Type::Kind::array:
        case Type::Kind::sequence: return read_elements(json, out, others);
        case Type::Kind::octets:
        case Type::Kind::text: {
            auto text = text_from_json(json);
            if (!text) return text.error().message;
            if (out.type->kind == Type::Kind::text) {
                out.as<std::string>() = std::move(*text);
            } else {
                out.as<Octets>().assign(text->begin(), text->end());
            }
            return "";
        }
        case Type::Kind::boolean:
            if (!json.is_boolean()) return expected_in_json("true or false", json);
            out.as<bool>() = json.get<bool>();
            return "";
        case Type::Kind::enumeration: {
            const auto& choices = out.type->choices;
            const auto found = json.is_string()
                                   ? std::find(choices.begin(), choices.end(), json.get_ref<const std::string&>())
                                   : choices.end();
            if (found == choices.end())
                return expected_in_json(fmt::format("one of {}", fmt::join(choices, ", ")), json);
            out.set_choice(static_cast<std::size_t>(found - choices.begin()));
            return "";
        }
        case Type::Kind::any: return read_any(json, out.as<Value>(), others);
        case Type::Kind::other: return others.read(json, out);
        default:
            return visit_number(out, [&]<class T>(T& number) -> std::string {
                if constexpr (std::is_floating_point_v<T>) {
                    double value = 0;
                    std::string wrong = read_number(json, value);
                    number = static_cast<T>(value);
                    return wrong;
                } else {
                    return read_whole(json, number);
                }
            });
    }
}

std::string read_plain(const Json& json, PlainData& out) {
    if (!json.is_object() || !json.contains("values") || !json.contains("tables"))
        return expected_in_json("values and tables", json);
    return read_value(json, out);
}

}  // namespace nezumi
