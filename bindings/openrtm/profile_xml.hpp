// Opens and saves XML files of OpenRTM's tools. A file must have no entities, limited size and depth, and valid UTF-8.
// Elements and attributes are found by names without prefixes.
#pragma once

#include <cstddef>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi::openrtm {

/// The largest profile that is read [bytes].
inline constexpr std::size_t largest_profile = std::size_t{4} << 20;
/// The deepest nesting of elements.
inline constexpr int deepest_profile = 100;

/// Parses `text` into `document` and returns its outermost element, whose name must be `root`. An error has `shown` as
/// its file name, and a line if one is known.
Expected<pugi::xml_node> open_profile(std::string_view text, const std::string& shown, std::string_view root,
                                      pugi::xml_document& document);

/// The reason why no tool can have written this document as a profile; "" if there is none.
std::string wrong_with(const pugi::xml_document& document);

/// Adds the outermost element to a new document.
pugi::xml_node begin_profile(pugi::xml_document& document, const char* root);
/// Returns the document as text. An error names a text with a character that XML can't hold.
Expected<std::string> save_profile(const pugi::xml_document& document);

/// The name without prefix: "DataPorts" for "rtc:DataPorts".
std::string_view local_name(std::string_view name);

/// The value of the attribute with this name and any prefix; "" if there is none. `xsi:type` does not count as "type".
std::string_view attribute_of(const pugi::xml_node& node, std::string_view name);

/// Replaces each HTML line break (`<br/>`) in a text of RTCBuilder by `instead`.
std::string without_html_breaks(std::string_view text, std::string_view instead);

/// The first element of this name, or an empty node.
pugi::xml_node element_of(const pugi::xml_node& node, std::string_view name);
/// All elements of this name, or all of any name if it is "".
std::vector<pugi::xml_node> elements_of(const pugi::xml_node& node, std::string_view name = "");

/// A property of OpenRTM's extensions: `<rtcExt:Properties rtcExt:name="..." rtcExt:value="..."/>`.
struct ProfileProperty {
    std::string name, value;
};
std::vector<ProfileProperty> properties_of(const pugi::xml_node& node);

}  // namespace nezumi::openrtm
