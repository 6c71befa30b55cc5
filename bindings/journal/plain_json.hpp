// Texts, numbers and plain data as JSON, for any bytes and numbers.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/components/plain_data.hpp"

namespace nezumi {

/// A text; one with invalid UTF-8 as its bytes: { "base64": "..." }.
nlohmann::ordered_json text_to_json(const std::string& text);
Expected<std::string> text_from_json(const nlohmann::ordered_json& json);
/// The same for the name of a member, which must be a text: "base64:...".
std::string text_to_key(const std::string& text);
Expected<std::string> text_from_key(const std::string& key);

/// A number, or { "number": "nan" }, "inf" or "-inf".
nlohmann::ordered_json number_to_json(double value);
/// Reads into `out`. Returns the error, or "".
std::string read_number(const nlohmann::ordered_json& json, double& out);

/// { "values": [...], "tables": [[[KEY, VALUE], ...], ...] }, where { "table": 0 } is the first table.
nlohmann::ordered_json plain_to_json(const PlainData& data);
/// As `read_number`.
std::string read_plain(const nlohmann::ordered_json& json, PlainData& out);

/// "expected a text, got 5": a long value is shortened.
std::string expected_in_json(std::string_view what, const nlohmann::ordered_json& got);

}  // namespace nezumi
