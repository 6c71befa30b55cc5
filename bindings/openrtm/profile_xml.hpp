// Opens the XML of OpenRTM's tools, without entities, of limited size and depth, valid UTF-8; and saves it. Names are
// looked up without their prefixes.
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
/// The most elements within each other.
inline constexpr int deepest_profile = 100;

/// Parses `text` into `document` and returns its outermost element, which must be called `root`. An error has `shown`
/// as its file, and a line where one is known.
Expected<pugi::xml_node> open_profile(std::string_view text, const std::string& shown, std::string_view root,
                                      pugi::xml_document& document);

/// Why this document is not a profile that a tool has written; "" if it may be one.
std::string wrong_with(const pugi::xml_document& document);

/// The outermost element of a new document.
pugi::xml_node begin_profile(pugi::xml_document& document, const char* root);
/// The document as text. An error names a text that XML can't hold.
Expected<std::string> save_profile(const pugi::xml_document& document);

/// "rtc:DataPorts" is "DataPorts".
std::string_view local_name(std::string_view name);

/// The value of an attribute with any prefix; "" if there is none. `xsi:type` is not an attribute called "type".
std::string_view attribute_of(const pugi::xml_node& node, std::string_view name);

/// A text of RTCBuilder, which has the line breaks of HTML (`<br/>`), with another text in place of each.
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
