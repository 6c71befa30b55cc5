// JSON has neither bytes nor numbers that are none: these are objects that say so.
#include "bindings/journal/plain_json.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <type_traits>
#include <utility>
#include <variant>

#include "bindings/journal/base64.hpp"

namespace nezumi {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view base64_key = "base64:";

bool is_utf8(std::string_view text) {
    for (std::size_t at = 0; at < text.size();) {
        const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
        const unsigned char first = byte(at);
        const std::size_t length = first < 0x80       ? 1
                                   : first >> 5 == 6  ? 2
                                   : first >> 4 == 14 ? 3
                                   : first >> 3 == 30 ? 4
                                                      : 0;
        if (length == 0 || at + length > text.size()) return false;
        std::uint32_t code = length == 1 ? first : first & (0x7fU >> length);
        for (std::size_t i = 1; i < length; ++i) {
            if (byte(at + i) >> 6 != 2) return false;
            code = code << 6 | (byte(at + i) & 63U);
        }
        constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
        if (code < least[length] || code > 0x10ffff || (code >= 0xd800 && code < 0xe000)) return false;
        at += length;
    }
    return true;
}

Json to_json(const PlainData::Value& value) {
    return std::visit(
        []<class T>(const T& each) -> Json {
            if constexpr (std::is_same_v<T, std::monostate>)
                return nullptr;
            else if constexpr (std::is_same_v<T, PlainData::TableRef>)
                return Json{{"table", each.index}};
            else if constexpr (std::is_same_v<T, double>)
                return number_to_json(each);
            else if constexpr (std::is_same_v<T, std::string>)
                return text_to_json(each);
            else
                return each;
        },
        value);
}

std::string read_plain(const Json& json, PlainData::Value& out, std::size_t tables) {
    if (json.is_null()) return out = std::monostate{}, "";
    if (json.is_boolean()) return out = json.get<bool>(), "";
    if (json.is_number_integer()) return out = json.get<std::int64_t>(), "";
    if (json.is_object() && json.contains("table")) {
        const Json& index = json["table"];
        if (!index.is_number_unsigned() || index.get<std::size_t>() >= tables)
            return expected_in_json("a table's number", index);
        return out = PlainData::TableRef{index.get<std::size_t>()}, "";
    }
    if (json.is_number() || (json.is_object() && json.contains("number"))) {
        double value = 0;
        const std::string wrong = read_number(json, value);
        return out = value, wrong;
    }
    auto text = text_from_json(json);
    if (!text) return text.error().message;
    return out = std::move(*text), "";
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
    return failure(expected_in_json("a text", json));
}

std::string text_to_key(const std::string& text) {
    return is_utf8(text) && !text.starts_with(base64_key) ? text : std::string(base64_key) + to_base64(text);
}

Expected<std::string> text_from_key(const std::string& key) {
    if (!key.starts_with(base64_key)) return key;
    auto text = from_base64(std::string_view(key).substr(base64_key.size()));
    if (!text) return failure(expected_in_json("a text", key));
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

Json plain_to_json(const PlainData& data) {
    Json values = Json::array();
    for (const PlainData::Value& value : data.values) values.push_back(to_json(value));
    Json tables = Json::array();
    for (const PlainData::Table& table : data.tables) {
        Json entries = Json::array();
        for (const auto& [key, value] : table) entries.push_back(Json::array({to_json(key), to_json(value)}));
        tables.push_back(std::move(entries));
    }
    return Json{{"values", std::move(values)}, {"tables", std::move(tables)}};
}

std::string read_plain(const Json& json, PlainData& out) {
    if (!json.is_object() || !json.contains("values") || !json.contains("tables") || !json["values"].is_array() ||
        !json["tables"].is_array())
        return expected_in_json("values and tables", json);
    const std::size_t count = json["tables"].size();
    for (const Json& value : json["values"]) {
        if (std::string wrong = read_plain(value, out.values.emplace_back(), count); !wrong.empty()) return wrong;
    }
    for (const Json& table : json["tables"]) {
        PlainData::Table& entries = out.tables.emplace_back();
        if (!table.is_array()) return expected_in_json("a table's entries", table);
        for (const Json& entry : table) {
            if (!entry.is_array() || entry.size() != 2) return expected_in_json("a key and a value", entry);
            auto& [key, value] = entries.emplace_back();
            if (std::string wrong = read_plain(entry[0], key, count); !wrong.empty()) return wrong;
            if (std::string wrong = read_plain(entry[1], value, count); !wrong.empty()) return wrong;
        }
    }
    return "";
}

}  // namespace nezumi
