// The name of this computer in name services.
#pragma once

#include <unistd.h>

#include <array>
#include <string>

namespace nezumi::openrtm {

/// Returns OpenRTM-aist's naming context for the RTCs of this computer: "pc.host_cxt".
inline std::string own_context() {
    std::array<char, 256> name{};
    const bool is_known = gethostname(name.data(), name.size() - 1) == 0 && name[0] != '\0';
    return std::string(is_known ? name.data() : "localhost") + ".host_cxt";
}

}  // namespace nezumi::openrtm
