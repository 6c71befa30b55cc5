// The container format MCAP, version 0 (mcap.dev/spec): the definitions that writer and reader share.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace nezumi::record {

/// The first and the last bytes of a file.
inline constexpr std::string_view mcap_magic{"\x89MCAP0\r\n", 8};

/// The kinds of records. A record is the byte of its kind, the length of the content in 8 bytes, and the content.
enum class Opcode : std::uint8_t {
    header = 0x01,
    footer = 0x02,
    schema = 0x03,
    channel = 0x04,
    message = 0x05,
    chunk = 0x06,
    message_index = 0x07,
    chunk_index = 0x08,
    statistics = 0x0B,
    metadata = 0x0C,
    summary_offset = 0x0E,
    data_end = 0x0F,
};

/// The definition of a channel's messages. The name "" means: no schema.
struct Schema {
    std::string name;      ///< "sensor_msgs/msg/LaserScan"
    std::string encoding;  ///< "ros2msg"
    std::string text;
    auto operator<=>(const Schema&) const = default;
};

struct RecordedChannel {
    std::string topic;
    std::string encoding;  ///< encoding of the messages: "cdr"
    Schema schema;
    std::map<std::string, std::string> metadata{};
};

/// A message of a channel.
struct RecordedMessage {
    std::uint16_t channel = 0;       ///< the channel's number
    std::uint64_t log_time = 0;      ///< [ns] time of the recording
    std::uint64_t publish_time = 0;  ///< [ns] stamp of the message
    std::string data{};              ///< in the channel's encoding
};

}  // namespace nezumi::record
