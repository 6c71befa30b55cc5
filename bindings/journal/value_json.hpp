// Values as JSON, with any bytes and numbers.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/values/plain_data.hpp"

namespace nezumi {

/// A text as a JSON string. One with invalid UTF-8 is written as its bytes: { "base64": "..." }.
nlohmann::ordered_json text_to_json(const std::string& text);
Expected<std::string> text_from_json(const nlohmann::ordered_json& json);
/// A text as the name of a member. One with invalid UTF-8 is written as "base64:...".
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

/// A value by its type's table: a structure as its fields, without those that hold nothing. A value of any type within
/// it is a boolean, a number or a text as they are, null for nothing, { "table": 0 } for a table of plain data,
/// else an object of its type's name and itself: { "numbers": [...] }, { "TimedVelocity2D": {...} }.
nlohmann::ordered_json value_to_json(const ValueView& value, const OtherForms& others = {});
/// As `read_number`.
std::string read_value(const nlohmann::ordered_json& json, const ValuePlace& out, const OtherForms& others = {});
/// Reads plain data. Like every value that was read, it needs no further check.
std::string read_plain(const nlohmann::ordered_json& json, PlainData& out);

/// "expected a string, got 5": a long value is shortened.
std::string expected_in_json(std::string_view what, const nlohmann::ordered_json& got);

}  // namespace nezumi
