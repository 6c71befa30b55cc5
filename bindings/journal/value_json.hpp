// Values as JSON, with any bytes and numbers.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/values/plain_data.hpp"

namespace nezumi {

/// A text as a JSON string. A text with invalid UTF-8 is written as its bytes: { "base64": "..." }.
nlohmann::ordered_json text_to_json(const std::string& text);
Expected<std::string> text_from_json(const nlohmann::ordered_json& json);
/// A text as a member name of a JSON object. A text with invalid UTF-8 is written as "base64:...".
std::string text_to_key(const std::string& text);
Expected<std::string> text_from_key(const std::string& key);

/// A number, or { "number": "nan" }, "inf" or "-inf".
nlohmann::ordered_json number_to_json(double value);
/// Reads into `out`. Returns the error, or "".
std::string read_number(const nlohmann::ordered_json& json, double& out);

/// The JSON functions for types that have no description.
struct OtherForms {
    std::function<nlohmann::ordered_json(const ValueView& value)> write{};
    std::function<std::string(const nlohmann::ordered_json& json, const ValuePlace& out)> read{};
    /// Finds a message type of a file by name; null if there is none. May be empty.
    std::function<const MessageType*(const std::string& name)> message{};
};

/// Writes a value by its type: a structure as an object of its fields, without empty optional ones. A member of type
/// `any` is a plain boolean, number or text, null for nothing, { "table": 0 } for a table of plain data; all others are
/// an object with the name of the type: { "numbers": [...] }, { "TimedVelocity2D": {...} }.
nlohmann::ordered_json value_to_json(const ValueView& value, const OtherForms& others = {});
/// Reads into `out`. Returns the error, or "".
std::string read_value(const nlohmann::ordered_json& json, const ValuePlace& out, const OtherForms& others = {});
/// Reads plain data and checks it. Returns the error, or "".
std::string read_plain(const nlohmann::ordered_json& json, PlainData& out);

/// "expected a string, got 5": a long value is shortened.
std::string expected_in_json(std::string_view what, const nlohmann::ordered_json& got);

}  // namespace nezumi
