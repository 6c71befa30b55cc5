// Loads the module with omniORB.
#include "bindings/openrtm/orb.hpp"

#include "engine/base/module.hpp"

namespace nezumi::openrtm {

Expected<std::unique_ptr<Orb>> open_orb(const OrbOptions& options, RtcSite& site) {
    static const auto opens = load_function(
        {.file = orb_module, .function = open_in_module, .part = "OpenRTM's components", .needs = "libomniorb4-2"});
    if (!opens) return failure(opens.error().message);
    std::string problem;
    std::unique_ptr<Orb> orb(reinterpret_cast<OpenInModule*>(*opens)(options, site, problem));
    if (orb == nullptr) return failure(problem);
    return orb;
}

}  // namespace nezumi::openrtm
