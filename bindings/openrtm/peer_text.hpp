// Messages to people about other programs' RTCs.
#pragma once

#include <string>

#include "bindings/openrtm/orb.hpp"

namespace nezumi::openrtm {

/// Returns a list of RTCs, the whole of one RTC, or the result of a request, over several lines. An error gives the
/// reason, with the most similar name.
Expected<std::string> told_of_peers(const PeerQuestion& question, const PeerAnswer& answer);

}  // namespace nezumi::openrtm
