// What is told to people of other programs' RTCs.
#pragma once

#include <string>

#include "bindings/openrtm/orb.hpp"

namespace nezumi::openrtm {

/// A list of RTCs, one of them whole, or what has come of a request, over several lines. The error says why not, with
/// the nearest name.
Expected<std::string> told_of_peers(const PeerQuestion& question, const PeerAnswer& answer);

}  // namespace nezumi::openrtm
