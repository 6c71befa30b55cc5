// Profiles of systems in rtsprofile's YAML: the same elements and attributes as in XML.
#pragma once

#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "engine/base/error.hpp"

namespace nezumi::openrtm {

/// Whether a text that should be a profile is not XML.
bool is_yaml_profile(std::string_view text);

/// Parses `text` into the elements of `document` and returns the outermost one, `RtsProfile`. An error has `shown` as
/// its file, and a line where one is known. Limits are those of XML; all aliases together give at most 100 000 values.
Expected<pugi::xml_node> open_yaml_profile(std::string_view text, const std::string& shown,
                                           pugi::xml_document& document);

/// A document of a system's profile as YAML. An error names a text that a profile can't hold.
Expected<std::string> save_yaml_profile(const pugi::xml_document& document);

}  // namespace nezumi::openrtm
