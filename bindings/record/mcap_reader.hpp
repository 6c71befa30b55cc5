// Reads MCAP files, ours and those of other programs: with chunks or without, compressed by zstd, lz4 or not at all.
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
    /// Sorted by log time; messages of the same time in the order of the file.
    std::vector<RecordedMessage> messages{};
    /// False: the writing program was killed; the messages up to then are there.
    bool is_complete = false;
};

/// The largest size of all messages together [bytes], before compression.
inline constexpr std::size_t most_recorded_bytes = std::size_t{4} << 30;

/// `name` is that of the file, for errors. Errors give the byte: a record with wrong lengths, a chunk with a wrong
/// checksum, an unknown compression, a message without a channel.
Expected<McapFile> read_mcap(std::string_view bytes, const std::string& name);

}  // namespace nezumi::record
