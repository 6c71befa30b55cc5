// Messages of ROS are converted as by `subscribe` in `ros { ... }` of a system file.
#include "bindings/cli/files/recorded_drive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "bindings/cli/files/recorded_topics.hpp"
#include "bindings/record/recorded_run.hpp"
#include "engine/messages/message_coding.hpp"

namespace nezumi::cli {
namespace {

using record::McapFile;
using record::RecordedMessage;

// The elements "gains[1]", "gains[2]", ... of an array, in their order.
std::optional<Value> array_in(const record::NamedValues& named, const ParameterSpec& spec) {
    const std::string begin = spec.name + "[";
    std::vector<std::string> texts;
    for (const record::NamedText& each : named.texts) {
        if (each.name.starts_with(begin)) texts.push_back(each.value);
    }
    if (!texts.empty()) return Value(std::move(texts));
    std::vector<double> numbers;
    for (const record::NamedNumber& each : named.numbers) {
        if (each.name.starts_with(begin)) numbers.push_back(each.value);
    }
    if (numbers.empty()) return std::nullopt;
    if (spec.initial.is<std::vector<bool>>()) return Value(std::vector<bool>(numbers.begin(), numbers.end()));
    if (spec.initial.is<std::vector<std::int64_t>>())
        return Value(std::vector<std::int64_t>(numbers.begin(), numbers.end()));
    return Value(std::move(numbers));
}

std::optional<Value> value_in(const record::NamedValues& named, const ParameterSpec& spec) {
    for (const record::NamedText& each : named.texts) {
        if (each.name == spec.name) return Value(each.value);
    }
    for (const record::NamedNumber& each : named.numbers) {
        if (each.name != spec.name) continue;
        if (spec.initial.is<bool>()) return Value(each.value != 0);
        if (spec.initial.is<std::int64_t>()) return Value(static_cast<std::int64_t>(each.value));
        return Value(each.value);
    }
    return array_in(named, spec);
}

}  // namespace

void read_parameters(RecordedDrive& drive, const McapFile& recording, const TopicReader& reader,
                     const Component& behavior) {
    const MessageCoding coding = coding_of_structure(type_of<record::NamedValues>());
    const std::string topic = record::topic_of(behavior.name() + ".config");
    for (const RecordedMessage& each : recording.messages) {
        if (recording.channels.at(each.channel).topic != topic) continue;
        const auto values = coding.read(bytes_of(each), 0);
        if (!values) continue;
        const auto& named = values->data.get<record::NamedValues>();
        for (const auto& parameter : behavior.parameters().all()) {
            if (const auto value = value_in(named, parameter.spec))
                drive.acts.emplace_back(reader.tick_of(each.log_time),
                                        SetParameter{behavior.name(), parameter.spec.name, *value});
        }
    }
}

Expected<void> read_drive(RecordedDrive& drive, const McapFile& recording, const TopicReader& reader,
                          const std::string& name, const Component& behavior, const TopicsOfPorts& topics) {
    drive.times = reader.times();
    drive.ticks = drive.times.empty() ? reader.ticks() : static_cast<std::int64_t>(drive.times.size());
    const auto read = [&](const Port& port, auto& ports) -> Expected<void> {
        const auto said = topics.find(port.name());
        const std::string topic =
            said != topics.end() ? said->second : record::topic_of(behavior.name() + "." + port.name());
        DrivePort kept;
        kept.type = port.type();
        const std::string what =
            fmt::format("{} '{}'", port.direction() == Direction::in ? "input" : "output", port.name());
        const auto exists = reader.read(topic, what, kept);
        if (!exists) return Unexpected(exists.error());
        if (!*exists && said != topics.end()) {
            return failure(fmt::format("there is no topic {}; the topics are {}", shown(topic), topics_of(recording)),
                           {name});
        }
        if (*exists) ports.emplace(port.name(), std::move(kept));
        return {};
    };
    for (const auto& [port, topic] : topics) {
        const auto has_name = [name = port](const Port* each) { return each->name() == name; };
        const auto ports = ports_of(behavior);
        if (std::any_of(ports.begin(), ports.end(), has_name)) continue;
        std::vector<std::string_view> names;
        names.reserve(ports.size());
        for (const Port* each : ports) names.push_back(each->name());
        return failure(fmt::format("--map: {} has no port '{}'{}; it has {}", behavior.name(), shown(port),
                                   did_you_mean(port, names), fmt::join(names, ", ")));
    }
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
        return failure(fmt::format("no output of {0} is recorded, so nothing can be compared: name the topic of an "
                                   "output with --map TOPIC={0}.PORT; the topics are {1}",
                                   behavior.name(), topics_of(recording)),
                       {name});
    }
    return {};
}

}  // namespace nezumi::cli
