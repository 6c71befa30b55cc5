// The system as a node of ROS 2: a component with a port for each topic.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bindings/dds/ros/mapping.hpp"
#include "bindings/dds/ros/ros_word.hpp"
#include "bindings/dds/transport.hpp"
#include "engine/components/component.hpp"
#include "engine/system/network.hpp"
#include "engine/system/system.hpp"

namespace nezumi::dds {

/// The settings of a node besides its topics.
struct RosNodeSettings {
    std::function<double()> clock = monotonic_seconds;  ///< [s], monotonic
    std::function<double()> wall_clock;                 ///< [s] since 1970: the time in ROS unless this is a simulation
};

class RosNode final : public Device {
public:
    /// Adds the node "ros/NAME" with its topics to a complete system, and connects it. An error has the location of the
    /// topic. Nothing is sent before the first tick.
    static Expected<RosNode*> add(System& system, const RosSpec& spec, DdsTransport& transport,
                                  RosNodeSettings settings);

    /// Called between two ticks, and repeatedly while time is stopped, as in `Network`.
    void between_ticks();
    /// Called once before each tick: writes the messages received since the last tick, as acts of ROS. Drops them while
    /// the node is not ACTIVE.
    void before_tick(const MessageDoor& deliver);

    /// Empty, because `before_tick` has written the received messages.
    void sense(const Time& /*now*/) override {}
    void actuate(const Time& now) override;

protected:
    Expected<void> on_deactivated() override;

private:
    struct Line {
        RosTopic said;
        ros::Mapping mapping;
        Port* port;  // of this node
    };

    RosNode(const System& system, const RosSpec& spec, DdsTransport& transport, RosNodeSettings settings);
    Expected<void> make_port(System& system, const RosTopic& topic, bool publishes);
    void open();
    struct Given;
    bool commands_robots(const Given& given) const;
    const Velocity2D* measured_by(const Given& given) const;
    double offset(const Time& now) const;
    double stamp() const;
    void send_clock(const Time& now);

    const System& system_;
    DdsTransport& transport_;
    RosNodeSettings settings_;
    std::vector<Line> lines_;
    bool opened_ = false;
    int turns_ = 0;           // calls since the last tick
    double received_at_ = 0;  // [s] by the clock
    struct Given {
        const InPortBase* port;
        std::unique_ptr<ros::Publication> publication;
        double sent_at = 0;  // [s] by the clock
    };
    std::vector<Given> publications_;
    struct Taken {
        const Port* port;
        std::unique_ptr<ros::Subscription> subscription;
        std::string told{};  // the error reported last
    };
    std::vector<Taken> subscriptions_;
    std::unique_ptr<Writer> clock_;
    Octets bytes_;
};

}  // namespace nezumi::dds
