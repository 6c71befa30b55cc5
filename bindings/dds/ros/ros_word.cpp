// Reads, checks and writes `ros { ... }`.
#include "bindings/dds/ros/ros_word.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <map>
#include <utility>

#include "bindings/dds/network_word.hpp"
#include "engine/base/lua_text.hpp"
#include "engine/base/names.hpp"
#include "engine/base/number_in.hpp"
#include "engine/records/write_record.hpp"

namespace nezumi::dds {
namespace {

// The error if this is not a topic name of ROS, or "" (ROS 2 design, "Topic and Service name mapping to DDS").
std::string problem_of_topic(std::string_view topic) {
    if (topic.size() < 2 || topic.front() != '/') return "expected a full name such as \"/odom\"";
    bool begins = false;  // a token of the name begins
    for (const char c : topic) {
        const bool digit = c >= '0' && c <= '9';
        const bool fits = digit || c == '_' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        if (c == '/' ? begins : !fits || (begins && digit))
            return "expected tokens of letters, digits and _ between slashes, none beginning with a digit";
        begins = c == '/';
    }
    return begins ? "expected no slash at the end" : "";
}

// Reads one entry of `publish` or `subscribe`: a string, or a table with more fields. `name` is the key of the entry.
void read_topic(FieldCheck& check, const Value& value, const FieldPath& path, const std::string& name, bool publishes,
                std::vector<RosTopic>& out) {
    RosTopic topic;
    topic.place = check.place_of(path);
    if (const std::string* text = value.get_if<std::string>()) {
        (publishes ? topic.topic : topic.port) = *text;
    } else if (value.get_if<FileTable>() != nullptr) {
        Fields fields(check, value, path);
        read_record(fields, topic);
        const std::string_view key = publishes ? "port" : "topic";
        if (fields.has(key)) check.wrong(fields.path_of(key), fmt::format("is already given by the name '{}'", name));
        fields.require(publishes ? "topic" : "port", publishes ? "a string: the topic" : "a string: \"name.port\"");
        fields.done();
    } else {
        check.wrong(path, fmt::format("expected a string or a table, got {}", kind_of(value)));
    }
    (publishes ? topic.port : topic.topic) = name;
    if (!check.ok()) return;
    if (const std::string problem = problem_of_topic(topic.topic); !problem.empty())
        return check.wrong(path, fmt::format("has an invalid topic '{}': {}", topic.topic, problem));
    out.push_back(std::move(topic));
}

// Reads `publish`, from ports to topics (a list for several topics of a port), or `subscribe`, from topics to ports.
void read_topics(Fields& fields, std::string_view name, std::vector<RosTopic>& out) {
    const bool publishes = name == "publish";
    Fields table = fields.inner(name);
    for (const FileField& each : table.all()) {
        const Value& value = *table.field(each.name);
        const FieldPath path = table.path_of(each.name);
        const FileTable* list = value.get_if<FileTable>();
        if (!publishes || list == nullptr || list->elements.empty() || !list->fields.empty()) {
            read_topic(fields.check(), value, path, each.name, publishes, out);
            continue;
        }
        for (const Value& element : list->elements)
            read_topic(fields.check(), element, path, each.name, publishes, out);
    }
    table.done();
}

// Uses the domain of the environment, as other ROS nodes do.
void use_environment(FieldCheck& check, std::int64_t& domain) {
    const char* said = std::getenv("ROS_DOMAIN_ID");
    if (said == nullptr || *said == '\0') return;
    const auto number = number_in<std::int64_t>(said);
    if (number && *number >= 0 && *number <= last_domain) {
        domain = *number;
    } else {
        check.wrong_at(
            {}, fmt::format("the environment's ROS_DOMAIN_ID: expected 0 to {}, got '{}'", last_domain, shown(said)));
    }
}

// Writes `publish` or `subscribe` as Lua. Each entry is a name, a table, or a list if a port has several topics.
std::string topics_text(std::string_view field, const std::vector<RosTopic>& all) {
    const bool publishes = field == "publish";
    std::map<std::string, std::vector<std::string>> by_name;
    for (const RosTopic& each : all) {
        RosTopic own = each;
        (publishes ? own.port : own.topic).clear();
        const bool named = own.type.empty() && own.frame.empty();
        by_name[publishes ? each.port : each.topic].push_back(named ? lua_quoted(publishes ? each.topic : each.port)
                                                                    : write_record(own));
    }
    std::string text;
    for (const auto& [name, entries] : by_name) {
        const std::string list = fmt::format("{}", fmt::join(entries, ", "));
        text += fmt::format("    [{}] = {},\n", lua_quoted(name), entries.size() == 1 ? list : "{ " + list + " }");
    }
    return text.empty() ? "" : fmt::format("  {} = {{\n{}  }},\n", field, text);
}

}  // namespace

std::vector<RecordShape> RosWord::records() const { return {shape_of_record<RosSpec>(), shape_of_record<RosTopic>()}; }

void RosWord::complete(RosSpec& given, Fields& fields, const PeerCall& /*call*/) const {
    FieldCheck& check = fields.check();
    if (!fields.has("domain")) use_environment(check, given.domain);
    read_topics(fields, "publish", given.publish);
    read_topics(fields, "subscribe", given.subscribe);
    check_peers(check, given.peers);
    if (check.ok() && !is_identifier(given.node))
        check.wrong({"node"},
                    fmt::format("expected letters, digits and _, not beginning with a digit, got '{}'", given.node));
}

std::string RosWord::text_of(const RosSpec& given) const {
    const std::string own = write_record(given);
    return fmt::format("ros {{\n  {}{},\n{}{}}}\n", own.substr(2, own.size() - 4), names_text("peers", given.peers),
                       topics_text("publish", given.publish), topics_text("subscribe", given.subscribe));
}

Expected<void> RosWord::check(const SystemSpec& system) const {
    const RosSpec* ros = find(system);
    const NetworkSpec* network = NetworkWord::find(system);
    if (ros == nullptr || network == nullptr || network->domain != ros->domain) return {};
    if (network->interface == ros->interface && network->peers == ros->peers) return {};
    return failure(fmt::format("ros: is in domain {} as network is: 'interface' and 'peers' must be the same in both",
                               ros->domain),
                   ros->place);
}

bool RosWord::remove_at(SystemSpec& system, const Place& place) const {
    const RosSpec* ros = find(system);
    if (ros == nullptr) return false;
    RosSpec rest = *ros;
    const auto is_there = [&](const RosTopic& topic) { return topic.place == place; };
    if (std::erase_if(rest.publish, is_there) + std::erase_if(rest.subscribe, is_there) > 0) {
        put(system, std::move(rest));
        return true;
    }
    return ros->place == place && system.peers.erase(std::string(name())) > 0;
}

const RosWord& ros_word() {
    static const RosWord word;
    return word;
}

}  // namespace nezumi::dds
