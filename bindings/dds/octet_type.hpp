// A message type for Cyclone DDS that is a plain sequence of bytes. nezumi encodes and decodes the bytes itself.
#pragma once

#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>

#include <cstdint>
#include <span>

namespace nezumi::dds {

/// Makes a type of this name without a key. If no topic has taken the type, release it with `ddsi_sertype_unref`. To
/// write a message, pass a `std::span<const std::uint8_t>`: CDR with its header.
ddsi_sertype* make_octet_type(const char* name);

/// The bytes of a message whose type was made by `make_octet_type`; valid while `data` lives.
std::span<const std::uint8_t> octets_of(const ddsi_serdata& data);

}  // namespace nezumi::dds
