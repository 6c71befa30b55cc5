// Makes the bytes of an MCAP file, piece by piece. The caller writes the pieces one after the other.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bindings/record/mcap.hpp"

namespace nezumi::record {

/// Channels and messages that come next in a file. A channel must come before its first message.
struct McapBatch {
    std::vector<std::pair<std::uint16_t, RecordedChannel>> channels{};  ///< by number; numbers begin with 0
    std::vector<RecordedMessage> messages{};
    std::size_t bytes = 0;  ///< approximate size of the messages
    bool empty() const { return channels.empty() && messages.empty(); }
};

/// One chunk of 1 s needs less space than 20 chunks of 50 ms, but a process that is killed loses the messages that are
/// in no chunk yet. So `small_chunk` is written often, and `whole_chunk` later replaces all small chunks since the last
/// whole one.
class McapWriter {
public:
    /// Returns the beginning of the file.
    std::string begin();
    void add(const McapBatch& batch);
    /// Returns a chunk, without an index, of the messages since the last chunk of either kind; "" if there are none.
    std::string small_chunk();
    /// Returns one chunk, with its index, of all messages since the last whole chunk; "" if there are none. It must
    /// replace the small chunks since then in the file.
    std::string whole_chunk();
    /// Returns the end of the file: the last whole chunk and the summary. It must replace the small chunks as well.
    std::string end();

private:
    struct Index {
        std::uint64_t log_time;
        std::uint64_t offset;  // [bytes] of the message in the records of its chunk
    };
    struct ChunkEntry {
        std::uint64_t begin, end;                        // [ns] of its messages
        std::uint64_t offset, length;                    // [bytes] of the chunk in the file
        std::map<std::uint16_t, std::uint64_t> indexes;  // [bytes] of the message indexes in the file, by channel
        std::uint64_t indexes_length, compressed, uncompressed;
    };
    struct Known {
        RecordedChannel channel;
        std::uint16_t schema = 0;  // number of its schema; 0: none
        std::uint64_t messages = 0;
    };

    std::string summary(std::uint64_t at);

    std::map<Schema, std::uint16_t> schemas_;  // numbers from 1 on
    std::map<std::uint16_t, Known> channels_;
    std::string pending_;       // records since the last whole chunk
    std::size_t in_small_ = 0;  // [bytes] of `pending_` that are in small chunks
    std::map<std::uint16_t, std::vector<Index>> indexes_;
    std::uint64_t pending_begin_ = 0, pending_end_ = 0;  // [ns]
    std::vector<ChunkEntry> chunks_;
    std::uint64_t written_ = 0;  // [bytes] up to the end of the last whole chunk
    std::uint64_t first_ = 0, last_ = 0, count_ = 0;
};

}  // namespace nezumi::record
