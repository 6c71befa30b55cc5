// Texts for the console about RTCs of other programs.
#pragma once

#include <string>

#include "bindings/openrtm/orb.hpp"

namespace nezumi::openrtm {

/// Describes an answer in one or more lines: a list of RTCs, one RTC with its details, or the result of a request. An
/// error gives the reason, with the most similar name.
Expected<std::string> told_of_peers(const PeerQuestion& question, const PeerAnswer& answer);

}  // namespace nezumi::openrtm
