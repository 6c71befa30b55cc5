// The RTCs of the name services as JSON, for the page.
#pragma once

#include <string>
#include <string_view>

#include "bindings/openrtm/orb.hpp"

namespace nezumi::openrtm {

/// Returns an object with `is` "rtcs"; `rtcs`: the RTCs of other programs; `connections`: those with ports of these
/// RTCs; `ports`: our exported ports, { "controller.in": "TimedShortSeq" }; or, after an error, the `problem`. RTCs in
/// `context`, that of this computer ("pc.host_cxt"), have short names, as in system files: "rtm:ConsoleOut0".
std::string peers_to_json(const PeerAnswer& answer, std::string_view context);

}  // namespace nezumi::openrtm
