// Topics of a recording as messages of ports.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bindings/journal/recorded_device.hpp"
#include "bindings/record/mcap_reader.hpp"
#include "engine/base/error.hpp"

namespace nezumi::cli {

/// The bytes of a message, without copying them.
std::span<const std::uint8_t> bytes_of(const record::RecordedMessage& message);

/// The names of all topics, sorted and separated by commas; "none".
std::string topics_of(const record::McapFile& recording);

/// Reads topics as messages at ticks. Times are counted from the first message, and a message arrives in the first tick
/// after its log time.
class TopicReader {
public:
    /// `name` is the file's name, for errors; `rate` is the tick rate [Hz]. The arguments must outlive the reader.
    TopicReader(const record::McapFile& recording, const std::string& name, double rate);
    /// For a run of nezumi on hardware at this `rate`, whose ticks have unequal distances: each tick in which something
    /// was recorded becomes a tick at the recorded time, up to the tick `end`. Times are counted from the start of the
    /// run.
    static TopicReader of_same_ticks(const record::McapFile& recording, const std::string& name, double rate,
                                     std::optional<std::int64_t> end);

    std::int64_t tick_of(std::uint64_t log_time) const;
    /// The number of ticks up to the last message.
    std::int64_t ticks() const;
    /// The times [s] of the ticks in which something was recorded, since the start of the run. Empty unless the reader
    /// was made by `of_same_ticks`.
    std::vector<double> times() const;
    /// Adds the messages of a topic to `kept`, whose type is set. Returns whether the topic exists. `what` is the port
    /// for errors: "input 'rays'". An error if the topic has another type.
    Expected<bool> read(const std::string& topic, const std::string& what, DrivePort& kept) const;

private:
    const record::McapFile& recording_;
    const std::string& name_;
    double rate_;
    std::uint64_t begin_ = 0;                      // [ns]
    std::map<std::uint64_t, std::int64_t> ticks_;  // of `of_same_ticks`, by log time
};

/// The ports of a recording by component and port.
using RecordedPorts = std::map<std::string, std::map<std::string, DrivePort, std::less<>>, std::less<>>;

/// Reads all topics whose messages are CDR with a definition: "/mouse/front/scan" is the port `front_scan` of `mouse`,
/// and "/scan" the port `scan` of `topics`. `names` gives topics other ports: {"/scan", "robot.scan"}. `skipped` gets a
/// line for each topic that can't be read. An error if `names` has an unknown topic or an invalid port, or if nothing
/// can be read.
Expected<RecordedPorts> read_topics(const record::McapFile& recording, const std::string& name, double rate,
                                    const std::map<std::string, std::string>& names, std::vector<std::string>& skipped);

}  // namespace nezumi::cli
