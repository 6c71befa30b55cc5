// Profiles of systems in the YAML format of rtsprofile, which has the same elements and attributes as the XML.
#pragma once

#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "engine/base/error.hpp"

namespace nezumi::openrtm {

/// True if a profile must be YAML, because the text is not XML.
bool is_yaml_profile(std::string_view text);

/// Parses `text` into the elements of `document` and returns the outermost one, `RtsProfile`. An error has `shown` as
/// its file name, and a line if one is known. The limits are those of XML, and at most 100 000 values after aliases are
/// resolved.
Expected<pugi::xml_node> open_yaml_profile(std::string_view text, const std::string& shown,
                                           pugi::xml_document& document);

/// Writes the document of a system's profile as YAML. An error names a text that a profile can't hold.
Expected<std::string> save_yaml_profile(const pugi::xml_document& document);

}  // namespace nezumi::openrtm
