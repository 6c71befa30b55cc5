// A place in a domain of Cyclone DDS, which is loaded on first use.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "bindings/dds/transport.hpp"
#include "engine/base/error.hpp"

namespace nezumi::dds {

/// How a domain is joined.
struct DomainOptions {
    std::uint32_t domain = 0;
    std::string xml;        ///< Cyclone's configuration, as `domain_xml` writes it
    bool loopback = false;  ///< that of the loopback: nothing that other computers send is heard
};

/// Joins a domain, or says why not. One place for each domain and process.
Expected<std::unique_ptr<DdsTransport>> open_cyclone(const DomainOptions& options);

// What the program and its module know of each other: they are built together.
inline constexpr const char* dds_module = "nezumi_cyclone.so";
inline constexpr const char* open_in_module = "nezumi_open_cyclone";
/// The module's one function: a new place, or nullptr with the `problem`. It throws nothing.
using OpenInModule = DdsTransport*(const DomainOptions& options, std::string& problem);

}  // namespace nezumi::dds
