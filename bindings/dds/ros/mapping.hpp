// The message types of ROS 2 that correspond to message types of ports. The documentation's table is made from this.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "bindings/dds/transport.hpp"
#include "engine/base/error.hpp"
#include "engine/messages/message_coding.hpp"
#include "engine/ports/messages.hpp"
#include "engine/ports/port_base.hpp"

namespace nezumi::ros {

/// Sends the messages of an in-port of the node on a topic.
class Publication {
public:
    virtual ~Publication() = default;
    /// Sends the messages that have arrived. `offset` [s]: ROS's time minus the system's time. `measured`: the measured
    /// velocity of the robot that the message comes from; nullptr if it does not come from a robot.
    virtual void send(double offset, const Velocity2D* measured) = 0;
    /// Sends velocity 0 instead of the received message. `stamp` [s]: the present time in ROS.
    virtual void send_zero(double stamp) = 0;
    /// True if the last message may move a robot: a velocity other than zero.
    virtual bool moves() const = 0;
};

/// Receives messages of a topic for an out-port of the node.
class Subscription {
public:
    using Give = std::function<void(Value value)>;

    virtual ~Subscription() = default;
    /// Gives the received messages. `clock` [s]: monotonic. Returns the error of a message, or "".
    virtual std::string receive(double clock, const Give& give) = 0;
};

struct Mapping {
    const MessageType* port_type = nullptr;
    std::string_view type;     ///< of ROS: "geometry_msgs/msg/Twist"
    std::string_view frame;    ///< default `frame_id` of the header; "" for none
    bool sensor_data = false;  ///< best effort, as ROS uses it for sensors
    const Type* definition = nullptr;
    std::function<std::unique_ptr<Publication>(InPortBase& port, std::unique_ptr<dds::Writer> writer,
                                               const std::string& frame)>
        publish{};
    /// None if this type can't be received.
    std::function<std::unique_ptr<Subscription>(std::unique_ptr<dds::Reader> reader)> subscribe{};
    /// The encoding for recordings. A message can be read from a recording only if `subscribe` is set.
    std::function<MessageCoding(const std::string& frame)> coding{};
};

/// The mappings of the compiled message types. The first mapping of a port's type is its default.
std::span<const Mapping> mappings();

/// The mapping of a port's type to the type `type` of ROS; "" means the default. A type that a file defines has the ROS
/// name that is given in the file. An error lists the possible types. `takes`: messages are received from ROS.
Expected<Mapping> find_mapping(const MessageType* port_type, std::string_view type, bool takes);

/// The encoding of a port's messages in recordings, as the type `type` of ROS. "" means the first type with a stamp, or
/// the first type if none has one. Nothing if there is no such type.
std::optional<MessageCoding> find_coding(const MessageType& port_type, std::string_view type = "");

/// The DDS topic of "/cmd_vel", with its quality of service.
dds::Topic topic_of(std::string_view name, const Mapping& mapping, bool writes);

}  // namespace nezumi::ros
