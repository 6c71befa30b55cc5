// The parameters of another program's RTC, with the widgets and bounds that it gives to tools.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bindings/openrtm/orb.hpp"
#include "engine/components/parameter.hpp"

namespace nezumi::openrtm {

struct PeerParameter {
    ParameterSpec spec{};  ///< `initial` has the parameter's type
    Value value{};         ///< the value in the active configuration set
};

/// The parameters of the active configuration set. Unknown widgets and bounds are left out. If the RTC gives no type,
/// parameters with a slider or a spin button are numbers, all others strings. A value that does not fit the type is a
/// string.
std::vector<PeerParameter> parameters_of(const PeerSnapshot& peer);

}  // namespace nezumi::openrtm
