// Topics of ROS become ports as `subscribe` of the word `ros` converts them.
#include "bindings/cli/files/recorded_drive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "bindings/dds/ros/mapping.hpp"
#include "bindings/record/recorded_run.hpp"
#include "engine/messages/message_coding.hpp"
#include "engine/messages/msg_text.hpp"

namespace nezumi::cli {
namespace {

using record::McapFile;
using record::RecordedChannel;
using record::RecordedMessage;

constexpr double rounding = 1e-6;  // ticks

std::span<const std::uint8_t> bytes_of(const RecordedMessage& message) {
    return {reinterpret_cast<const std::uint8_t*>(message.data.data()), message.data.size()};
}

// The coding of a port's type that a topic has.
std::optional<MessageCoding> coding_in(const RecordedChannel& channel, const MessageType& type) {
    if (channel.encoding != "cdr") return std::nullopt;
    if (auto coding = ros::find_coding(type, channel.schema.name); coding && coding->read) return coding;
    if (MessageCoding own = own_coding(type); own.type == channel.schema.name) return own;
    return std::nullopt;
}

class DriveReader {
public:
    DriveReader(RecordedDrive& drive, const McapFile& recording, const std::string& name)
        : drive_(drive), recording_(recording), name_(name) {
        if (!recording.messages.empty()) begin_ = recording.messages.front().log_time;
        for (const RecordedMessage& each : recording.messages)
            drive_.ticks = std::max(drive_.ticks, tick_of(each.log_time) + 1);
    }

    // Reads the messages of a topic into a port; returns whether the topic exists.
    Expected<bool> read(const std::string& topic, const Port& port, DrivePort& kept) {
        kept.type = port.type();
        bool exists = false;
        for (const auto& [number, channel] : recording_.channels) {
            if (channel.topic != topic) continue;
            exists = true;
            const auto coding = coding_in(channel, *port.type());
            if (!coding) {
                return failure(
                    fmt::format("topic {} has {}, which can't be read into {} '{}' ({})", topic,
                                shown(channel.schema.name), port.direction() == Direction::in ? "input" : "output",
                                port.name(), port.type()->name),
                    {name_});
            }
            for (const RecordedMessage& each : recording_.messages) {
                if (each.channel != number) continue;
                auto message = coding->read(bytes_of(each), record::to_seconds(each.publish_time));
                if (!message)
                    return failure(fmt::format("a message of {}: {}", topic, message.error().message), {name_});
                message->tm -= record::to_seconds(begin_);
                kept.messages.emplace_back(tick_of(each.log_time), std::move(*message));
            }
        }
        std::stable_sort(kept.messages.begin(), kept.messages.end(),
                         [](const auto& left, const auto& right) { return left.first < right.first; });
        return exists;
    }

    // Sets the parameters to recorded numbers and texts. Arrays keep their values.
    void read_parameters(const Component& behavior) {
        const MessageCoding coding = coding_of_structure(type_of<record::NamedValues>());
        const std::string topic = record::topic_of(behavior.name() + ".config");
        for (const RecordedMessage& each : recording_.messages) {
            if (recording_.channels.at(each.channel).topic != topic) continue;
            const auto values = coding.read(bytes_of(each), 0);
            if (!values) continue;
            const auto& named = values->data.get<record::NamedValues>();
            for (const auto& parameter : behavior.parameters().all()) {
                if (const auto value = value_in(named, parameter.spec))
                    drive_.acts.emplace_back(tick_of(each.log_time),
                                             SetParameter{behavior.name(), parameter.spec.name, *value});
            }
        }
    }

private:
    static std::optional<Value> value_in(const record::NamedValues& named, const ParameterSpec& spec) {
        for (const record::NamedText& each : named.texts) {
            if (each.name == spec.name) return Value(each.value);
        }
        for (const record::NamedNumber& each : named.numbers) {
            if (each.name != spec.name) continue;
            if (spec.initial.is<bool>()) return Value(each.value != 0);
            if (spec.initial.is<std::int64_t>()) return Value(static_cast<std::int64_t>(each.value));
            return Value(each.value);
        }
        return std::nullopt;
    }

    std::int64_t tick_of(std::uint64_t log_time) const {
        const double seconds = record::to_seconds(log_time - begin_);
        return static_cast<std::int64_t>(std::ceil(seconds * drive_.rate - rounding));
    }

    RecordedDrive& drive_;
    const McapFile& recording_;
    const std::string& name_;
    std::uint64_t begin_ = 0;  // [ns]
};

std::string topics_of(const McapFile& recording) {
    std::vector<std::string> topics;
    for (const auto& [number, channel] : recording.channels) topics.push_back(channel.topic);
    std::sort(topics.begin(), topics.end());
    return topics.empty() ? "none" : fmt::format("{}", fmt::join(topics, ", "));
}

}  // namespace

Expected<void> read_drive(RecordedDrive& drive, const McapFile& recording, const std::string& name,
                          const Component& behavior, const TopicsOfPorts& topics) {
    DriveReader reader(drive, recording, name);
    const auto read = [&](const Port& port, auto& ports) -> Expected<void> {
        const auto said = topics.find(port.name());
        const std::string topic =
            said != topics.end() ? said->second : record::topic_of(behavior.name() + "." + port.name());
        DrivePort kept;
        const auto exists = reader.read(topic, port, kept);
        if (!exists) return Unexpected(exists.error());
        if (!*exists && said != topics.end()) {
            return failure(fmt::format("there is no topic {}; the topics are {}", shown(topic), topics_of(recording)),
                           {name});
        }
        if (*exists) ports.emplace(port.name(), std::move(kept));
        return {};
    };
    for (const auto& port : behavior.in_ports()) {
        if (auto done = read(*port, drive.arrived); !done) return done;
        if (!drive.arrived.contains(port->name())) {
            return failure(fmt::format("input '{0}' is not recorded: name its topic with --map TOPIC={1}.{0}; the "
                                       "topics are {2}",
                                       port->name(), behavior.name(), topics_of(recording)),
                           {name});
        }
    }
    for (const auto& port : behavior.out_ports()) {
        if (auto done = read(*port, drive.published); !done) return done;
    }
    if (drive.published.empty()) {
        return failure(fmt::format("no output of {0} is recorded, so there is nothing to compare with: name a topic "
                                   "with --map TOPIC={0}.PORT; the topics are {1}",
                                   behavior.name(), topics_of(recording)),
                       {name});
    }
    reader.read_parameters(behavior);
    return {};
}

}  // namespace nezumi::cli
