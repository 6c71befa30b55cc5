// In place of cyclone.cpp in a static program, which can load no module.
#include "bindings/dds/cyclone.hpp"

namespace nezumi::dds {

Expected<std::unique_ptr<DdsTransport>> open_cyclone(const DomainOptions& /*options*/) {
    return failure("this nezumi is one static program, without the part for networks");
}

}  // namespace nezumi::dds
