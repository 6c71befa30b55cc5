// The RTCs of the name services as JSON, for the page.
#pragma once

#include <string>
#include <string_view>

#include "bindings/openrtm/orb.hpp"

namespace nezumi::openrtm {

/// An object with `is` "rtcs", all other programs' `rtcs`, the `connections` of theirs, and our `ports` as others know
/// them: { "controller.in": "TimedShortSeq" }; or with the `problem`. `context` is this computer's, "pc.host_cxt": the
/// RTCs in it have short names, as in system files: "rtm:ConsoleOut0".
std::string peers_to_json(const PeerAnswer& answer, std::string_view context);

}  // namespace nezumi::openrtm
