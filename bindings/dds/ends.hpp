// The names of ports on the network: "host/name.port".
#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace nezumi::dds {

/// Both ends of a connection between two hosts: from, to.
using Ends = std::pair<std::string, std::string>;

/// "host" of "host/name.port", and the rest.
inline std::string_view host_of(std::string_view path) { return path.substr(0, path.find('/')); }
inline std::string_view without_host(std::string_view path) { return path.substr(path.find('/') + 1); }

}  // namespace nezumi::dds
