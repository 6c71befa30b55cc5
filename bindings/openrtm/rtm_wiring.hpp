// Which connections there can be between ports of a system and other programs' RTCs.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "bindings/openrtm/rtm_spec.hpp"
#include "engine/base/error.hpp"
#include "engine/system/system.hpp"
#include "engine/values/value.hpp"

namespace nezumi::openrtm {

/// The repository id by which OpenRTM-aist knows a message type: "IDL:RTC/TimedShortSeq:1.0", or what the file that
/// defines it says. "" for none: what was added to OpenRTM's own types, and definitions without a name there.
std::string rtm_type_id(const MessageType& type);

/// Writes a message as RTCs exchange it: with its stamp [s], if the type has one there.
void write_rtm_message(Octets& out, const MessageType& type, const ValueView& data, double tm, std::endian order);
/// Reads a message in this format into `data`, a value of the type's payload.
Expected<void> read_rtm_message(std::span<const std::uint8_t> bytes, const MessageType& type, const ValuePlace& data,
                                std::endian order);

/// The error if a component's port can't be connected to `end`, a port of another program, because the component is not
/// exported.
std::string needs_export(std::string_view end, std::string_view component);

/// The two ends of a connection.
struct RtmEnds {
    std::string ours;  ///< "controller.in"
    RtmPath theirs;
};

/// The ends of a connection between a port of a system and a port of an RTC. Exactly one end must be an RTC's, and the
/// other end must be a port with the right direction and a type that OpenRTM knows.
Expected<RtmEnds> rtm_ends(const System& system, const ConnectionSpec& connection);

}  // namespace nezumi::openrtm
