// Reads MCAP files of nezumi and of other programs: with or without chunks, compressed by zstd or lz4 or uncompressed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/record/mcap.hpp"
#include "engine/base/error.hpp"

namespace nezumi::record {

/// Whether these are the first bytes of an MCAP file.
bool is_mcap(std::string_view bytes);

struct McapFile {
    std::map<std::uint16_t, RecordedChannel> channels{};
    /// Sorted by log time; messages with the same time are in the order of the file.
    std::vector<RecordedMessage> messages{};
    /// False: the file has no end, because the program that wrote it was killed; it has the messages up to then.
    bool is_complete = false;
};

/// The largest size of all messages together [bytes], before compression.
inline constexpr std::size_t most_recorded_bytes = std::size_t{4} << 30;

/// Reads a file. `name` is its name in errors. Errors have the position of the byte: a record with a wrong length, a
/// chunk with a wrong checksum, an unknown compression, a message without a channel.
Expected<McapFile> read_mcap(std::string_view bytes, const std::string& name);

}  // namespace nezumi::record
