// A participant in a domain of Cyclone DDS; the library is loaded on first use.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "bindings/dds/transport.hpp"
#include "engine/base/error.hpp"

namespace nezumi::dds {

/// Options for joining a domain.
struct DomainOptions {
    std::uint32_t domain = 0;
    std::string xml;        ///< Cyclone's configuration, as `domain_xml` writes it
    bool loopback = false;  ///< uses the loopback interface: messages of other computers are ignored
};

/// Joins a domain. One participant per domain and process.
Expected<std::unique_ptr<DdsTransport>> open_cyclone(const DomainOptions& options);

// The interface between the program and its module, which are always built together.
inline constexpr const char* dds_module = "nezumi_cyclone.so";
inline constexpr const char* open_in_module = "nezumi_open_cyclone";
/// The only function that the module exports. Returns a new participant, or sets `problem` and returns nullptr. Never
/// throws.
using OpenInModule = DdsTransport*(const DomainOptions& options, std::string& problem);

}  // namespace nezumi::dds
