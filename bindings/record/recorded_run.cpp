// The messages that only nezumi's own recordings have: journal, log and named values.
#include "bindings/record/recorded_run.hpp"

#include <fmt/format.h>

#include <cmath>
#include <span>

#include "engine/messages/message_coding.hpp"

namespace nezumi::record {
namespace {

constexpr std::uint64_t second = 1'000'000'000;  // [ns]

// Levels of rcl_interfaces/msg/Log.
std::uint8_t ros_level(LogLevel level) {
    constexpr std::uint8_t levels[] = {10, 20, 30, 40};
    return levels[static_cast<std::size_t>(level)];
}

}  // namespace

std::string topic_of(std::string_view path) {
    std::string topic = "/";
    for (const char c : path) topic += c == '.' ? '/' : c;
    return topic;
}

std::uint64_t to_nanoseconds(double seconds) {
    if (!(seconds > 0)) return 0;
    constexpr double most = 9e9;  // [s]
    return static_cast<std::uint64_t>(std::llround(std::fmin(seconds, most) * static_cast<double>(second)));
}

double to_seconds(std::uint64_t nanoseconds) { return static_cast<double>(nanoseconds) / static_cast<double>(second); }

RosLog to_ros(const LogLine& line, double tm) {
    const std::uint64_t stamp = to_nanoseconds(tm);
    return {.stamp = {static_cast<std::int32_t>(stamp / second), static_cast<std::uint32_t>(stamp % second)},
            .level = ros_level(line.level),
            .name = line.component,
            .msg = line.text,
            .file = {},
            .function = {}};
}

Expected<std::string> journal_of(const McapFile& recording, const std::string& name) {
    const MessageCoding text = coding_of_structure(type_of<RosString>());
    std::string journal;
    for (const RecordedMessage& message : recording.messages) {
        if (recording.channels.at(message.channel).topic != journal_topic) continue;
        const std::span bytes(reinterpret_cast<const std::uint8_t*>(message.data.data()), message.data.size());
        const auto read = text.read(bytes, 0);
        if (!read) return failure(fmt::format("a message of {}: {}", journal_topic, read.error().message), {name});
        journal += read->data.get<RosString>().data;
    }
    if (journal.empty())
        return failure(
            fmt::format("has no {}: {}, so the run can't be repeated", journal_topic,
                        recording.is_complete ? "nezumi run --record did not write it"
                                              : "it was cut off before that, or nezumi run --record did not write it"),
            {name});
    return journal;
}

}  // namespace nezumi::record
