// How the messages of a port are written for programs of ROS 2, and read again.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "engine/base/error.hpp"
#include "engine/ports/port_base.hpp"

namespace nezumi {

/// Messages in CDR, with the 4 bytes of RTPS before them.
struct MessageCoding {
    std::string type;        ///< in ROS: "sensor_msgs/msg/LaserScan"
    std::string definition;  ///< `msg_text` of it
    /// Replaces `out` by a message with this payload and stamp `tm` [s].
    std::function<void(Octets& out, const ValueView& payload, double tm)> write;
    /// Reads a message. `tm` [s]: its stamp if this type has none. An error if the bytes are not such a message.
    std::function<Expected<AnyMessage>(std::span<const std::uint8_t> bytes, double tm)> read;
};

/// The coding of a message type that ROS has no type for: its stamp `tm`, and its payload in `data`. Its name is
/// "nezumi_msgs/msg/TimedShortSeq".
MessageCoding own_coding(const MessageType& type);

/// The coding of a described structure as a whole message, without a stamp.
MessageCoding coding_of_structure(const Type& type);

}  // namespace nezumi
