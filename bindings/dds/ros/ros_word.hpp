// `ros` in system files: makes this system a node of ROS 2.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/dds/domain_fields.hpp"
#include "engine/base/error.hpp"
#include "engine/ports/setting.hpp"
#include "engine/system/peer_word_of.hpp"

namespace nezumi {
namespace dds {

/// A topic of ROS 2, and the port that it is published from or written to.
struct RosTopic {
    std::string port;  ///< "name.port"
    std::string topic;
    std::string type{};   ///< in ROS; "": the first possible type for the port's type
    std::string frame{};  ///< `frame_id` of the header; "": the default of the type
    Place place{};
};

/// `ros { node, publish, subscribe, domain, interface, peers }`.
struct RosSpec {
    std::string node;
    std::vector<RosTopic> publish{};
    std::vector<RosTopic> subscribe{};
    std::int64_t domain = 0;
    std::string interface {};  ///< "": the loopback
    std::vector<std::string> peers{};
    Place place{};
};

}  // namespace dds

/// One entry of `publish` or `subscribe`, if a name alone is not enough.
template <>
struct Describe<dds::RosTopic> {
    static constexpr std::string_view name = "ros_topic";
    static constexpr std::string_view doc = "A topic of ROS 2, if a name alone is not enough.";
    static constexpr FieldList fields{
        Setting{"topic", &dds::RosTopic::topic, "", "of `publish`: its name, for example \"/odom\""},
        Setting{"port", &dds::RosTopic::port, "", "of `subscribe`: the in-port, \"name.port\""},
        Setting{"type",
                &dds::RosTopic::type,
                "",
                "the message's type, for example \"geometry_msgs/msg/TwistStamped\"",
                {.fallback = "the first for the port's type"}},
        Setting{"frame",
                &dds::RosTopic::frame,
                "",
                "the `frame_id` of the message's header",
                {.fallback = "the type's default"}},
        Internal{&dds::RosTopic::place},
    };
};

template <>
struct Describe<dds::RosSpec> {
    static constexpr std::string_view name = "ros";
    static constexpr std::string_view doc = "This system is a node among those of ROS 2.";
    static constexpr FieldList fields{
        Setting{"node", &dds::RosSpec::node, "", "the node's name", {.required = true}},
        Extra{"publish", "table<string, string|RosTopicFields|any[]>", "",
              "out-ports and the topics that carry them: `[\"mouse.current_velocity_out\"] = \"/velocity\"`"},
        Extra{"subscribe", "table<string, string|RosTopicFields>", "",
              "topics and the in-ports that take them: `[\"/cmd_vel\"] = \"mouse.target_velocity_in\"`"},
        Setting{"domain",
                &dds::RosSpec::domain,
                "",
                "the ROS_DOMAIN_ID of the other nodes",
                {.min = 0, .max = dds::last_domain}},
        Setting{"interface",
                &dds::RosSpec::interface,
                "",
                "the network interface, for example \"wlan0\"",
                {.fallback = "the loopback: processes of this machine"}},
        Setting{"peers", &dds::RosSpec::peers, "", "addresses of hosts, if the network has no multicast"},
        Internal{&dds::RosSpec::publish},
        Internal{&dds::RosSpec::subscribe},
        Internal{&dds::RosSpec::place},
    };
};

namespace dds {

class RosWord final : public PeerWordOf<RosSpec> {
public:
    std::vector<RecordShape> records() const override;
    bool needs_network() const override { return true; }
    Expected<void> check(const SystemSpec& system) const override;
    bool remove_at(SystemSpec& system, const Place& place) const override;

protected:
    void complete(RosSpec& given, Fields& fields, const PeerCall& call) const override;
    std::string text_of(const RosSpec& given) const override;
};

const RosWord& ros_word();

}  // namespace dds
}  // namespace nezumi
