// A system's components as RTCs see them: ports, parameters as texts, states.
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

/// The components that a system exports. Ports of types that OpenRTM-aist does not know are left out. An error where
/// `rename` names a port that is not there, or gives two ports one name.
Expected<std::vector<RtcProfile>> profiles_of(const System& system, const RtmSpec& rtm);

/// The connections to other programs' RTCs. An error where a port is not there, leads the wrong way, or is of a type
/// that can't be exported.
Expected<std::vector<RtcLink>> links_of(const System& system, const std::vector<ConnectionSpec>& connections);

/// State and parameters, as they are now.
RtcSnapshot look_at(const Component& component);

/// A parameter's type as OpenRTM's tools know it: "double", "vector<long>".
std::string rtc_type_of(const Value& value);
/// Its widget likewise: "slider.0.01", "radio", ...; "" where the tool may choose.
std::string rtc_widget_of(const ParameterSpec& spec);

/// A parameter's value as a configuration set has it: "0.1", "true", "1,2,3", a text as it is.
std::string to_rtc_text(const ValueView& value);
/// The value of a text, of the type of `like`; nothing if the text is not such a value.
std::optional<Value> from_rtc_text(const std::string& text, const Value& like);

}  // namespace nezumi::openrtm
