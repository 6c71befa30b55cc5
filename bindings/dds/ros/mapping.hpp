// Which message types of ports become which of ROS 2: the one list, from which the documentation's table is made too.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "bindings/dds/transport.hpp"
#include "engine/base/error.hpp"
#include "engine/ports/messages.hpp"
#include "engine/ports/port_base.hpp"

namespace nezumi::ros {

/// Sends what an in-port of the node takes as messages of a topic.
class Publication {
public:
    virtual ~Publication() = default;
    /// Sends what has come. `offset` [s]: what ROS calls now, less what the system does. `measured`: what the wheels of
    /// the robot that it comes from do, if it comes from one.
    virtual void send(double offset, const Velocity2D* measured) = 0;
    /// Sends a zero in the place of what has come. `stamp` [s]: what ROS calls now.
    virtual void send_zero(double stamp) = 0;
    /// Whether the last message may move a robot: it was a velocity, and not zero.
    virtual bool moves() const = 0;
};

/// Takes messages of a topic for an out-port of the node.
class Subscription {
public:
    using Give = std::function<void(Value value)>;

    virtual ~Subscription() = default;
    /// Gives what has come. `clock` [s]: monotonic. Returns what was wrong with a message, "" when nothing was.
    virtual std::string receive(double clock, const Give& give) = 0;
};

struct Mapping {
    std::size_t port_type = 0;  ///< place in `message_types`
    std::string_view type;      ///< of ROS: "geometry_msgs/msg/Twist"
    std::string_view frame;     ///< of its header, unless the system says another; "" for none
    bool sensor_data = false;   ///< best effort, as what sensors measure is in ROS
    const Type& (*definition)() = nullptr;
    std::unique_ptr<Publication> (*publish)(InPortBase& port, std::unique_ptr<dds::Writer> writer,
                                            std::string frame) = nullptr;
    /// None where nothing of this type can be taken.
    std::unique_ptr<Subscription> (*subscribe)(std::unique_ptr<dds::Reader> reader) = nullptr;
};

/// For a port's type the first is the one that is meant where no type is said.
std::span<const Mapping> mappings();

/// The mapping for a port of this type to a type of ROS, or for "" to the first; an error that names what there is.
/// `takes`: from ROS.
Expected<const Mapping*> find_mapping(std::size_t port_type, std::string_view type, bool takes);

/// "/cmd_vel" as DDS knows it: with what its readers and writers promise each other.
dds::Topic topic_of(std::string_view name, const Mapping& mapping, bool writes);

/// The table of the documentation.
std::string mapping_table();

}  // namespace nezumi::ros
