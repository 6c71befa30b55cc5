// A parameter in RTCBuilder's profile, in both directions.
#pragma once

#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "engine/components/parameter.hpp"

namespace nezumi::openrtm {

/// Reads a `Configuration` element. The result is a valid declaration, except for its name. What of it can't be used is
/// added to `remarks`; nothing if no part of it can.
std::optional<ParameterSpec> read_parameter(const pugi::xml_node& configuration, std::vector<std::string>& remarks);

/// The zero value of a type as RTCBuilder and RTCs name it: "double", "std::vector<long>"; nothing for an unknown one.
std::optional<Value> zero_of_rtc_type(std::string_view name);

/// Adds a `Configuration` element.
void write_parameter(const ParameterSpec& spec, pugi::xml_node configuration_set);

/// A default or a choice as a profile has it: a text that begins and ends with quotes gets a second pair,
/// because readers remove one pair.
std::string profile_text(const Value& value);

/// Adds a property of OpenRTM's extensions to an element.
void add_property(pugi::xml_node element, const char* name, const std::string& value);

}  // namespace nezumi::openrtm
