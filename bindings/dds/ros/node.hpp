// The node that a system is among those of ROS 2: a component with a port for each topic.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bindings/dds/ros/mapping.hpp"
#include "bindings/dds/transport.hpp"
#include "engine/components/component.hpp"
#include "engine/system/network.hpp"
#include "engine/system/system.hpp"

namespace nezumi::dds {

/// What a node is beside its topics.
struct RosNodeSettings {
    std::function<double()> clock = monotonic_seconds;  ///< [s], never backwards
    std::function<double()> wall_clock;                 ///< [s] since 1970: what ROS calls now, where robots are real
};

class RosNode final : public Device {
public:
    /// Adds the node "ros/NAME" to a system that has all its other components, with what its topics say, and connects
    /// it. The error has the place of the topic. Nothing is on the network before the first tick.
    static Expected<RosNode*> add(System& system, const RosSpec& spec, DdsTransport& transport,
                                  RosNodeSettings settings);

    /// As of `Network`: between two ticks, again and again only while time stands.
    void between_ticks();
    /// Once before each tick: has what came since the last one written, as acts of ROS; nothing while this is not
    /// ACTIVE.
    void before_tick(const MessageDoor& deliver);

    /// What comes is there before the tick.
    void sense(const Time& /*now*/) override {}
    void actuate(const Time& now) override;

protected:
    Expected<void> on_deactivated() override;

private:
    struct Line {
        RosTopic said;
        const ros::Mapping* mapping;
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
    int turns_ = 0;           // between this tick and the last one
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
        std::string told{};  // what was wrong: once
    };
    std::vector<Taken> subscriptions_;
    std::unique_ptr<Writer> clock_;
    Octets bytes_;
};

}  // namespace nezumi::dds
