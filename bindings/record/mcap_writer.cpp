// Every number is little-endian; a text is its length in 4 bytes and its bytes.
#include "bindings/record/mcap_writer.hpp"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <cassert>
#include <concepts>
#include <string_view>

namespace nezumi::record {
namespace {

constexpr int fast = 1, usual = 3;  // compression levels of zstd

template <std::unsigned_integral T>
void put(std::string& out, T number) {
    for (std::size_t i = 0; i < sizeof number; ++i) out += static_cast<char>(number >> (8 * i) & 0xff);
}

void put_text(std::string& out, std::string_view text) {
    put(out, static_cast<std::uint32_t>(text.size()));
    out += text;
}

void put_texts(std::string& out, const std::map<std::string, std::string>& texts) {
    std::string entries;
    for (const auto& [name, text] : texts) {
        put_text(entries, name);
        put_text(entries, text);
    }
    put_text(out, entries);
}

void put_record(std::string& out, Opcode opcode, std::string_view content) {
    put(out, static_cast<std::uint8_t>(opcode));
    put(out, static_cast<std::uint64_t>(content.size()));
    out += content;
}

std::uint32_t checksum(std::string_view bytes) {
    return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

struct Packed {
    std::string record;  // the chunk as a record
    std::uint64_t compressed;
};

Packed pack(std::string_view records, std::uint64_t begin, std::uint64_t end, int level) {
    std::string packed(ZSTD_compressBound(records.size()), '\0');
    const std::size_t size = ZSTD_compress(packed.data(), packed.size(), records.data(), records.size(), level);
    assert(ZSTD_isError(size) == 0);
    packed.resize(size);
    std::string content;
    put(content, begin);
    put(content, end);
    put(content, static_cast<std::uint64_t>(records.size()));
    put(content, checksum(records));
    put_text(content, "zstd");
    put(content, static_cast<std::uint64_t>(packed.size()));
    content += packed;
    Packed made{{}, packed.size()};
    put_record(made.record, Opcode::chunk, content);
    return made;
}

void put_schema(std::string& records, std::uint16_t number, const Schema& schema) {
    std::string content;
    put(content, number);
    put_text(content, schema.name);
    put_text(content, schema.encoding);
    put_text(content, schema.text);
    put_record(records, Opcode::schema, content);
}

void put_channel(std::string& records, std::uint16_t number, std::uint16_t schema, const RecordedChannel& channel) {
    std::string content;
    put(content, number);
    put(content, schema);
    put_text(content, channel.topic);
    put_text(content, channel.encoding);
    put_texts(content, channel.metadata);
    put_record(records, Opcode::channel, content);
}

}  // namespace

std::string McapWriter::begin() {
    std::string out(mcap_magic);
    std::string header;
    put_text(header, "ros2");  // all channels are CDR with definitions of ROS 2
    put_text(header, "nezumi");
    put_record(out, Opcode::header, header);
    written_ = out.size();
    return out;
}

void McapWriter::add(const McapBatch& batch) {
    for (const auto& [number, channel] : batch.channels) {
        Known& known = channels_[number];
        known.channel = channel;
        if (!channel.schema.name.empty()) {
            known.schema =
                schemas_.try_emplace(channel.schema, static_cast<std::uint16_t>(schemas_.size() + 1)).first->second;
            put_schema(pending_, known.schema, channel.schema);
        }
        put_channel(pending_, number, known.schema, channel);
    }
    for (const RecordedMessage& message : batch.messages) {
        const std::uint64_t at = message.log_time;
        const bool is_first = indexes_.empty();
        pending_begin_ = is_first ? at : std::min(pending_begin_, at);
        pending_end_ = is_first ? at : std::max(pending_end_, at);
        first_ = count_ == 0 ? at : std::min(first_, at);
        last_ = count_ == 0 ? at : std::max(last_, at);
        ++count_;
        indexes_[message.channel].push_back({at, pending_.size()});
        const std::uint64_t number = ++channels_[message.channel].messages;
        put(pending_, static_cast<std::uint8_t>(Opcode::message));
        put(pending_, static_cast<std::uint64_t>(2 + 4 + 8 + 8 + message.data.size()));
        put(pending_, message.channel);
        put(pending_, static_cast<std::uint32_t>(number));
        put(pending_, at);
        put(pending_, message.publish_time);
        pending_ += message.data;
    }
}

std::string McapWriter::small_chunk() {
    if (in_small_ == pending_.size()) return "";
    const std::size_t from = std::exchange(in_small_, pending_.size());
    return pack(std::string_view(pending_).substr(from), pending_begin_, pending_end_, fast).record;
}

std::string McapWriter::whole_chunk() {
    if (pending_.empty()) return "";
    Packed packed = pack(pending_, pending_begin_, pending_end_, usual);
    ChunkEntry entry{.begin = pending_begin_,
                     .end = pending_end_,
                     .offset = written_,
                     .length = packed.record.size(),
                     .indexes = {},
                     .indexes_length = 0,
                     .compressed = packed.compressed,
                     .uncompressed = pending_.size()};
    std::string out = std::move(packed.record);
    for (const auto& [channel, places] : indexes_) {
        entry.indexes[channel] = written_ + out.size();
        std::string content;
        put(content, channel);
        put(content, static_cast<std::uint32_t>(places.size() * 16));
        for (const Index& each : places) {
            put(content, each.log_time);
            put(content, each.offset);
        }
        put_record(out, Opcode::message_index, content);
    }
    entry.indexes_length = out.size() - entry.length;
    chunks_.push_back(std::move(entry));
    written_ += out.size();
    pending_.clear();
    in_small_ = 0;
    indexes_.clear();
    return out;
}

std::string McapWriter::summary(std::uint64_t at) {
    struct Group {
        Opcode opcode;
        std::uint64_t begin, length;
    };
    std::string out;
    std::vector<Group> groups;
    const auto group = [&](Opcode opcode, auto write) {
        const std::uint64_t begin = out.size();
        write();
        if (out.size() > begin) groups.push_back({opcode, at + begin, out.size() - begin});
    };
    group(Opcode::schema, [&] {
        for (const auto& [schema, number] : schemas_) put_schema(out, number, schema);
    });
    group(Opcode::channel, [&] {
        for (const auto& [number, known] : channels_) put_channel(out, number, known.schema, known.channel);
    });
    group(Opcode::statistics, [&] {
        std::string content, counts;
        put(content, count_);
        put(content, static_cast<std::uint16_t>(schemas_.size()));
        put(content, static_cast<std::uint32_t>(channels_.size()));
        put(content, std::uint32_t{0});  // attachments
        put(content, std::uint32_t{0});  // metadata
        put(content, static_cast<std::uint32_t>(chunks_.size()));
        put(content, first_);
        put(content, last_);
        for (const auto& [number, known] : channels_) {
            put(counts, number);
            put(counts, known.messages);
        }
        put_text(content, counts);
        put_record(out, Opcode::statistics, content);
    });
    group(Opcode::chunk_index, [&] {
        for (const ChunkEntry& each : chunks_) {
            std::string content, offsets;
            put(content, each.begin);
            put(content, each.end);
            put(content, each.offset);
            put(content, each.length);
            for (const auto& [channel, offset] : each.indexes) {
                put(offsets, channel);
                put(offsets, offset);
            }
            put_text(content, offsets);
            put(content, each.indexes_length);
            put_text(content, "zstd");
            put(content, each.compressed);
            put(content, each.uncompressed);
            put_record(out, Opcode::chunk_index, content);
        }
    });
    const std::uint64_t offsets_at = at + out.size();
    for (const Group& each : groups) {
        std::string content;
        put(content, static_cast<std::uint8_t>(each.opcode));
        put(content, each.begin);
        put(content, each.length);
        put_record(out, Opcode::summary_offset, content);
    }
    // The checksum covers the summary, and the footer up to the checksum.
    put(out, static_cast<std::uint8_t>(Opcode::footer));
    put(out, std::uint64_t{8 + 8 + 4});
    put(out, at);
    put(out, offsets_at);
    put(out, checksum(out));
    return out;
}

std::string McapWriter::end() {
    std::string out = whole_chunk();
    const std::size_t before = out.size();
    std::string content;
    put(content, std::uint32_t{0});  // 0: there is no checksum of all data
    put_record(out, Opcode::data_end, content);
    written_ += out.size() - before;
    out += summary(written_);
    return out += mcap_magic;
}

}  // namespace nezumi::record
