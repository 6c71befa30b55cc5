// The messages of a topic have a type of nezumi if one fits, else a type made from the definition in the recording.
#include "bindings/cli/files/recorded_topics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <utility>

#include "bindings/cli/files/ros_definition.hpp"
#include "bindings/dds/ros/mapping.hpp"
#include "bindings/record/recorded_run.hpp"
#include "engine/base/names.hpp"
#include "engine/messages/message_coding.hpp"
#include "engine/ports/port_base.hpp"
#include "engine/system/pacer.hpp"

namespace nezumi::cli {
namespace {

using record::McapFile;
using record::RecordedChannel;
using record::RecordedMessage;

constexpr double rounding = 1e-6;  // ticks

// The conversion of a channel's messages to this type; std::nullopt if there is none.
std::optional<MessageCoding> coding_in(const RecordedChannel& channel, const MessageType& type) {
    if (channel.encoding != "cdr") return std::nullopt;
    if (auto coding = ros::find_coding(type, channel.schema.name); coding && coding->read) return coding;
    if (MessageCoding own = own_coding(type); own.type == channel.schema.name) return own;
    return std::nullopt;
}

// The type of a port for the messages of this channel.
Expected<const MessageType*> type_of_channel(const RecordedChannel& channel) {
    if (channel.encoding != "cdr") return failure(fmt::format("its messages are {}, not cdr", shown(channel.encoding)));
    if (const auto its = channel.metadata.find("nezumi_type"); its != channel.metadata.end()) {
        const auto type = find_message_type(its->second);
        if (type && coding_in(channel, **type)) return *type;
    }
    for (const MessageType& each : compiled_message_types()) {
        if (coding_in(channel, each)) return &each;
    }
    return type_of_definition(channel.schema);
}

// Makes a name that a component or a port may have: other characters become underscores.
std::string name_of_part(std::string_view part) {
    std::string name;
    for (const char c : part) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front())) != 0) name.insert(0, "_");
    return name;
}

std::string name_of_component(std::string_view part) {
    const std::string name = name_of_part(part);
    return is_reserved_name(name) ? name + "_" : name;
}

std::pair<std::string, std::string> port_of_topic(std::string_view topic) {
    while (topic.starts_with('/')) topic.remove_prefix(1);
    const std::size_t slash = topic.find('/');
    if (slash == std::string_view::npos) return {"topics", name_of_part(topic)};
    return {name_of_component(topic.substr(0, slash)), name_of_part(topic.substr(slash + 1))};
}

Expected<std::pair<std::string, std::string>> port_called(const std::string& path) {
    const std::size_t dot = path.find('.');
    const std::string component = path.substr(0, dot);
    const std::string port = dot == path.npos ? "" : path.substr(dot + 1);
    if (!is_identifier(component) || !is_identifier(port) || is_reserved_name(component))
        return failure(fmt::format("expected COMPONENT.PORT as in robot.scan, got '{}'", shown(path)));
    return std::pair(component, port);
}

}  // namespace

std::span<const std::uint8_t> bytes_of(const RecordedMessage& message) {
    return {reinterpret_cast<const std::uint8_t*>(message.data.data()), message.data.size()};
}

std::string topics_of(const McapFile& recording) {
    std::vector<std::string> topics;
    for (const auto& [number, channel] : recording.channels) topics.push_back(channel.topic);
    std::sort(topics.begin(), topics.end());
    return topics.empty() ? "none" : fmt::format("{}", fmt::join(topics, ", "));
}

TopicReader::TopicReader(const McapFile& recording, const std::string& name, double rate)
    : recording_(recording), name_(name), rate_(rate) {
    if (!recording.messages.empty()) begin_ = recording.messages.front().log_time;
}

TopicReader TopicReader::of_same_ticks(const McapFile& recording, const std::string& name, double rate,
                                       std::optional<std::int64_t> end) {
    TopicReader reader(recording, name, rate);
    reader.begin_ = 0;
    const auto is_of_port = [&](const RecordedMessage& message) {
        return recording.channels.at(message.channel).metadata.contains(std::string(record::port_entry));
    };
    for (const RecordedMessage& message : recording.messages) {
        if (is_of_port(message)) reader.ticks_.emplace(message.log_time, 0);
    }
    // Numbers the ticks as `System::tick` does, which skips ticks after a stall.
    std::int64_t next = 0;
    for (auto& [log_time, tick] : reader.ticks_) {
        const std::int64_t due = std::llround(record::to_seconds(log_time) * rate);
        tick = due - next > Pacer::longest_burst ? due : next;
        next = tick + 1;
    }
    std::erase_if(reader.ticks_, [&](const auto& each) { return end && each.second >= *end; });
    return reader;
}

std::vector<double> TopicReader::times() const {
    std::vector<double> times;
    for (const auto& [log_time, tick] : ticks_) times.push_back(record::to_seconds(log_time));
    return times;
}

std::int64_t TopicReader::tick_of(std::uint64_t log_time) const {
    if (const auto next = ticks_.lower_bound(log_time); next != ticks_.end()) return next->second;
    if (!ticks_.empty()) return ticks_.rbegin()->second + 1;
    return static_cast<std::int64_t>(std::ceil(record::to_seconds(log_time - begin_) * rate_ - rounding));
}

std::int64_t TopicReader::ticks() const {
    return recording_.messages.empty() ? 0 : tick_of(recording_.messages.back().log_time) + 1;
}

Expected<bool> TopicReader::read(const std::string& topic, const std::string& what, DrivePort& kept) const {
    bool exists = false;
    for (const auto& [number, channel] : recording_.channels) {
        if (channel.topic != topic) continue;
        exists = true;
        const auto coding = coding_in(channel, *kept.type);
        if (!coding) {
            return failure(fmt::format("topic {} has messages of type {}, which can't be converted for {} ({})", topic,
                                       shown(channel.schema.name), what, kept.type->name),
                           {name_});
        }
        for (const RecordedMessage& each : recording_.messages) {
            if (each.channel != number) continue;
            auto message = coding->read(bytes_of(each), record::to_seconds(each.publish_time));
            if (!message) return failure(fmt::format("a message of {}: {}", topic, message.error().message), {name_});
            message->tm -= record::to_seconds(begin_);
            kept.messages.emplace_back(tick_of(each.log_time), std::move(*message));
        }
    }
    std::stable_sort(kept.messages.begin(), kept.messages.end(),
                     [](const auto& left, const auto& right) { return left.first < right.first; });
    return exists;
}

Expected<RecordedPorts> read_topics(const McapFile& recording, const std::string& name, double rate,
                                    const std::map<std::string, std::string>& names,
                                    std::vector<std::string>& skipped) {
    for (const auto& [topic, path] : names) {
        const bool exists = std::any_of(recording.channels.begin(), recording.channels.end(),
                                        [&, t = topic](const auto& each) { return each.second.topic == t; });
        if (!exists) {
            return failure(fmt::format("there is no topic {}; the topics are {}", shown(topic), topics_of(recording)),
                           {name});
        }
    }
    const TopicReader reader(recording, name, rate);
    RecordedPorts ports;
    for (const auto& [number, channel] : recording.channels) {
        // Named values and the journal are not messages of ports.
        if (channel.schema.name == record::NamedValues::type_name || channel.topic == record::journal_topic) continue;
        auto at = port_of_topic(channel.topic);
        if (const auto named = names.find(channel.topic); named != names.end()) {
            auto called = port_called(named->second);
            if (!called) return failure(fmt::format("topic {}: {}", channel.topic, called.error().message), {name});
            at = std::move(*called);
        }
        const auto type = type_of_channel(channel);
        if (!type) {
            skipped.push_back(
                fmt::format("topic {} ({}) is left out: {}", channel.topic, channel.schema.name, type.error().message));
            continue;
        }
        DrivePort kept{.type = *type};
        if (ports[at.first].contains(at.second)) continue;  // another channel of the same topic
        const auto read = reader.read(channel.topic, fmt::format("port '{}'", at.second), kept);
        if (!read) {
            skipped.push_back(fmt::format("topic {} is left out: {}", channel.topic, read.error().message));
        } else {
            ports[at.first].emplace(at.second, std::move(kept));
        }
    }
    std::erase_if(ports, [](const auto& each) { return each.second.empty(); });
    if (!ports.empty()) return ports;
    const std::string why = skipped.empty() ? "it has no topics" : skipped.front();
    return failure("nothing in this recording can be shown: " + why, {name});
}

}  // namespace nezumi::cli
