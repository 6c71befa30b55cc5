// How the messages of a port are written for programs of ROS 2, and read again.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "engine/base/error.hpp"
#include "engine/ports/port_base.hpp"

namespace nezumi {

/// How the messages of a type are converted to CDR, with the 4 bytes of RTPS at the start, and back.
struct MessageCoding {
    std::string type;        ///< the name in ROS: "sensor_msgs/msg/LaserScan"
    std::string definition;  ///< the `msg_text` of the type
    /// Replaces `out` by a message with this payload and stamp `tm` [s].
    std::function<void(Octets& out, const ValueView& payload, double tm)> write;
    /// Reads a message. If the type has no stamp, the message gets the stamp `tm` [s]. An error if the bytes are not a
    /// message of this type.
    std::function<Expected<AnyMessage>(std::span<const std::uint8_t> bytes, double tm)> read;
};

/// The coding of a message type for which ROS has no type: a structure with the stamp `tm` and the payload `data`,
/// named for example "nezumi_msgs/msg/TimedShortSeq".
MessageCoding own_coding(const MessageType& type);

/// The coding of a described structure as a whole message, without a stamp.
MessageCoding coding_of_structure(const Type& type);

}  // namespace nezumi
