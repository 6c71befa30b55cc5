// Rules for connections between ports of a system and ports of other programs' RTCs.
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

/// The repository id of a message type in OpenRTM-aist: "IDL:RTC/TimedShortSeq:1.0", or the id given in the file that
/// defines the type. "" if there is none: for nezumi's own types, and for files that give no id.
std::string rtm_type_id(const MessageType& type);

/// Encodes a message for RTCs: with its stamp [s], if the type has a stamp in OpenRTM.
void write_rtm_message(Octets& out, const MessageType& type, const ValueView& data, double tm, std::endian order);
/// Reads a message in this format into `data`, a value of the type's payload.
Expected<void> read_rtm_message(std::span<const std::uint8_t> bytes, const MessageType& type, const ValuePlace& data,
                                std::endian order);

/// The error that `end`, a port of another program, can't be connected to a port of `component`, because the component
/// is not exported.
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
