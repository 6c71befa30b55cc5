// Lists topics with their ROS names. Topics that carry ports between hosts are listed with the hosts instead.
#include "bindings/dds/domain_list.hpp"

#include <fmt/format.h>

#include <map>
#include <set>
#include <string_view>

#include "engine/base/visible.hpp"

namespace nezumi::dds {
namespace {

// Converts "geometry_msgs::msg::dds_::Twist_" to ROS's form "geometry_msgs/msg/Twist".
std::string ros_type(std::string_view type) {
    std::string text(type);
    if (const std::size_t inner = text.find("dds_::"); inner != std::string::npos) text.erase(inner, 6);
    for (std::size_t at = 0; (at = text.find("::", at)) != std::string::npos;) text.replace(at, 2, 1, '/');
    if (!text.empty() && text.back() == '_') text.pop_back();
    return text;
}

struct TopicEnds {
    std::set<std::string> types;
    int writers = 0, readers = 0;
};

std::string counted(int count, std::string_view noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace

std::string list_domain(const std::vector<const Announcement*>& hosts, const std::vector<SeenEndpoint>& seen) {
    std::string text;
    for (const Announcement* host : hosts)
        text += fmt::format("host {}  nezumi {}, {}\n", host->head.host, visible(host->head.version),
                            counted(static_cast<int>(host->ports.size()), "port"));
    constexpr std::string_view ros = "rt/";
    std::map<std::string, TopicEnds> topics;
    for (const SeenEndpoint& each : seen) {
        if (each.own || !each.topic.starts_with(ros)) continue;
        TopicEnds& ends = topics[each.topic.substr(ros.size() - 1)];
        ends.types.insert(ros_type(each.type));
        ++(each.writes ? ends.writers : ends.readers);
    }
    for (const auto& [name, ends] : topics)
        text += fmt::format("topic {}  {}  {}, {}\n", visible(name),
                            visible(fmt::format("{}", fmt::join(ends.types, ", "))), counted(ends.writers, "publisher"),
                            counted(ends.readers, "subscriber"));
    return text;
}

}  // namespace nezumi::dds
