// A type of messages for Cyclone DDS that are octets: what they mean is said by the descriptions in engine/ports.
#pragma once

#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>

#include <cstdint>
#include <span>

namespace nezumi::dds {

/// A type of this name without a key, which is released by `ddsi_sertype_unref` where no topic has taken it. What is
/// written is a `std::span<const std::uint8_t>`: CDR with its header.
ddsi_sertype* make_octet_type(const char* name);

/// The octets of a message of such a type, as long as that lives.
std::span<const std::uint8_t> octets_of(const ddsi_serdata& data);

}  // namespace nezumi::dds
