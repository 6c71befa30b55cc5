// A parameter in RTCBuilder's profile, in both directions.
#pragma once

#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "engine/components/parameter.hpp"

namespace nezumi::openrtm {

/// Reads a `Configuration` element. The result is a valid declaration, except for its name. Parts that can't be used
/// are added to `remarks`. Nothing if no part can be used.
std::optional<ParameterSpec> read_parameter(const pugi::xml_node& configuration, std::vector<std::string>& remarks);

/// The zero value of a type with this name in RTCBuilder and RTCs: "double", "std::vector<long>"; nothing if the type
/// is unknown.
std::optional<Value> zero_of_rtc_type(std::string_view name);

/// Adds a `Configuration` element.
void write_parameter(const ParameterSpec& spec, pugi::xml_node configuration_set);

/// Writes a default or a choice for a profile. A string that begins and ends with quotes gets a second pair, because
/// readers remove one pair.
std::string profile_text(const Value& value);

/// Adds a property of OpenRTM's extensions to an element.
void add_property(pugi::xml_node element, const char* name, const std::string& value);

}  // namespace nezumi::openrtm
