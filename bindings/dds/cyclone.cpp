// Loads the module with Cyclone DDS.
#include "bindings/dds/cyclone.hpp"

#include "engine/base/module.hpp"

namespace nezumi::dds {

Expected<std::unique_ptr<DdsTransport>> open_cyclone(const DomainOptions& options) {
    static const auto opens =
        load_function({.file = dds_module, .function = open_in_module, .part = "networks", .needs = "libddsc0debian"});
    if (!opens) return failure(opens.error().message);
    std::string problem;
    std::unique_ptr<DdsTransport> transport(reinterpret_cast<OpenInModule*>(*opens)(options, problem));
    if (transport == nullptr) return failure(problem);
    return transport;
}

}  // namespace nezumi::dds
