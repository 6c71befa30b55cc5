// Texts, numbers and plain data as JSON, whatever bytes and numbers they are.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/components/plain_data.hpp"

namespace nezumi {

/// A text, or of one that is no UTF-8 its bytes: { "base64": "..." }.
nlohmann::ordered_json text_to_json(const std::string& text);
Expected<std::string> text_from_json(const nlohmann::ordered_json& json);
/// The same as the name of a member, which can only be a text: "base64:...".
std::string text_to_key(const std::string& text);
Expected<std::string> text_from_key(const std::string& key);

/// A number, or { "number": "nan" }, "inf" or "-inf".
nlohmann::ordered_json number_to_json(double value);
/// What is read into `out`. Returns what is wrong, "" for nothing.
std::string read_number(const nlohmann::ordered_json& json, double& out);

/// { "values": [...], "tables": [[[KEY, VALUE], ...], ...] }, where { "table": 0 } stands for the first of the tables.
nlohmann::ordered_json plain_to_json(const PlainData& data);
/// As `read_number`.
std::string read_plain(const nlohmann::ordered_json& json, PlainData& out);

/// "expected a text, got 5": a long one is cut.
std::string expected_in_json(std::string_view what, const nlohmann::ordered_json& got);

}  // namespace nezumi
