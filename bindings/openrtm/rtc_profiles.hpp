// Describes a system's components as RTCs: ports, parameters as texts, states.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bindings/openrtm/orb.hpp"
#include "bindings/openrtm/rtm_spec.hpp"
#include "engine/components/component.hpp"
#include "engine/system/system.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi::openrtm {

/// The components that a system exports. Ports whose type has no name in OpenRTM-aist are left out. An error if
/// `rename` names a port that does not exist, or gives two ports the same name.
Expected<std::vector<RtcProfile>> profiles_of(const System& system, const RtmSpec& rtm);

/// The connections to other programs' RTCs. An error if a port does not exist, has the wrong direction, or has a type
/// that can't be exported.
Expected<std::vector<RtcLink>> links_of(const System& system, const std::vector<ConnectionSpec>& connections);

/// The present state and parameters of a component.
RtcSnapshot look_at(const Component& component);

/// The name of a parameter's type in OpenRTM's tools: "double", "vector<long>".
std::string rtc_type_of(const Value& value);
/// The name of a parameter's widget in OpenRTM's tools: "slider.0.01", "radio", ...; "" if the tool may choose.
std::string rtc_widget_of(const ParameterSpec& spec);

/// Converts a parameter's value to the text in a configuration set: "0.1", "true", "1,2,3"; strings are unchanged.
std::string to_rtc_text(const ValueView& value);
/// Converts a text to a value of the type of `like`; nothing if the text is not such a value.
std::optional<Value> from_rtc_text(const std::string& text, const Value& like);

}  // namespace nezumi::openrtm
