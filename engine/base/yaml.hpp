// Reads YAML of other programs: values by their keys, with their locations.
#pragma once

#include <yaml-cpp/yaml.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi {

/// Parses a text. The error has `file` and the line.
Expected<YAML::Node> read_yaml(std::string_view text, const std::string& file);

/// The value of a key; an undefined node if there is none.
YAML::Node yaml_field(const YAML::Node& mapping, const std::string& key);

/// The location of a value.
Place yaml_place(const YAML::Node& value, const std::string& file);

/// A value as text: a single value as it is written, a list or mapping as YAML; "" if it is undefined.
std::string yaml_text(const YAML::Node& value);

/// The value, if it is one finite number.
std::optional<double> yaml_number(const YAML::Node& value);

/// The elements of a list, if they are finite numbers.
std::optional<std::vector<double>> yaml_numbers(const YAML::Node& value);

/// The value, if it is a boolean: 0, 1, or a YAML word such as true, yes or off, in upper or lower case.
std::optional<bool> yaml_boolean(const YAML::Node& value);

}  // namespace nezumi
