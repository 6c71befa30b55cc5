// The parameters of another program's RTC, with the widgets and bounds that it gives to tools.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bindings/openrtm/orb.hpp"
#include "engine/components/parameter.hpp"

namespace nezumi::openrtm {

struct PeerParameter {
    ParameterSpec spec{};  ///< its `initial` is of the parameter's type
    Value value{};         ///< in the set in use
};

/// The parameters of the set in use. A widget or a bound that is not understood is left out. Without a type, a number
/// is only what has a slider or a spin button; everything else is a text. A value that does not fit its type is a text.
std::vector<PeerParameter> parameters_of(const PeerSnapshot& peer);

}  // namespace nezumi::openrtm
