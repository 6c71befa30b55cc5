// In place of orb.cpp where nezumi was built without omniORB, or as a static program, which can load no module.
#include "bindings/openrtm/orb.hpp"

namespace nezumi::openrtm {

Expected<std::unique_ptr<Orb>> open_orb(const OrbOptions& /*options*/, RtcSite& /*site*/) {
    return failure(
        "this nezumi was built without the part for OpenRTM's components: build it where libomniorb4-dev and "
        "omniidl are installed, and not as a static program");
}

}  // namespace nezumi::openrtm
