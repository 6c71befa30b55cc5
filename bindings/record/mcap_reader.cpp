// The data section is read from the start: neither the summary nor indexes are needed.
#include "bindings/record/mcap_reader.hpp"

#include <fmt/format.h>
#include <lz4frame.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <concepts>
#include <memory>
#include <optional>
#include <utility>

namespace nezumi::record {
namespace {

// The largest size of a chunk [bytes], before compression.
constexpr std::size_t most_chunk_bytes = std::size_t{256} << 20;

// Takes numbers and texts from a record's content. After the end, every number is 0 and every text "".
class Content {
public:
    explicit Content(std::string_view bytes) : bytes_(bytes) {}

    template <std::unsigned_integral T>
    T number() {
        T number = 0;
        const std::string_view taken = take(sizeof number);
        for (std::size_t i = 0; i < taken.size(); ++i)
            number = static_cast<T>(number |
                                    static_cast<T>(static_cast<T>(static_cast<unsigned char>(taken[i])) << (8 * i)));
        return number;
    }
    std::string_view text() { return take(number<std::uint32_t>()); }
    std::string_view take(std::uint64_t size) {
        if (size > bytes_.size()) {
            is_whole_ = false;
            bytes_ = {};
            return {};
        }
        const std::string_view taken = bytes_.substr(0, size);
        bytes_.remove_prefix(size);
        return taken;
    }
    std::string_view rest() { return std::exchange(bytes_, {}); }
    bool empty() const { return bytes_.empty(); }
    bool is_whole() const { return is_whole_; }

private:
    std::string_view bytes_;
    bool is_whole_ = true;
};

std::optional<std::string> unpack_zstd(std::string_view packed, std::size_t size) {
    std::string out(size, '\0');
    const std::size_t made = ZSTD_decompress(out.data(), out.size(), packed.data(), packed.size());
    if (ZSTD_isError(made) != 0 || made != size) return std::nullopt;
    return out;
}

std::optional<std::string> unpack_lz4(std::string_view packed, std::size_t size) {
    LZ4F_dctx* made = nullptr;
    if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION)) != 0) return std::nullopt;
    const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(made,
                                                                                       LZ4F_freeDecompressionContext);
    std::string out(size, '\0');
    std::size_t filled = 0;
    while (!packed.empty()) {
        std::size_t room = out.size() - filled, taken = packed.size();
        const std::size_t left =
            LZ4F_decompress(context.get(), out.data() + filled, &room, packed.data(), &taken, nullptr);
        if (LZ4F_isError(left) != 0 || (taken == 0 && room == 0)) return std::nullopt;
        filled += room;
        packed.remove_prefix(taken);
        if (left == 0 && packed.empty()) break;
    }
    if (filled != size) return std::nullopt;
    return out;
}

// Reads the records of one file.
class McapReader {
public:
    explicit McapReader(const std::string& name) : name_(name) {}

    Expected<McapFile> read(std::string_view bytes) {
        if (!is_mcap(bytes)) return failure("is not an MCAP file", {name_});
        const bool ends_well = bytes.size() >= 2 * mcap_magic.size() && bytes.ends_with(mcap_magic);
        auto done = read_records(bytes, mcap_magic.size(), 0);
        // If a program is killed, its file has no end, and the last record may be incomplete: the records before are
        // used.
        if (!done && ends_well) return Unexpected(done.error());
        file_.is_complete = ends_well;
        std::stable_sort(file_.messages.begin(), file_.messages.end(),
                         [](const auto& left, const auto& right) { return left.log_time < right.log_time; });
        return std::move(file_);
    }

private:
    // Reads the records from `at` on. `chunk`: the position of the chunk in the file [bytes], for errors; 0: not in a
    // chunk.
    Expected<void> read_records(std::string_view bytes, std::size_t at, std::size_t chunk) {
        while (at < bytes.size()) {
            here_ = chunk > 0 ? chunk : at;
            Content head(bytes.substr(at));
            const auto opcode = static_cast<Opcode>(head.number<std::uint8_t>());
            const auto length = head.number<std::uint64_t>();
            const std::string_view content = head.take(length);
            if (!head.is_whole()) return wrong("the record is longer than the file or its chunk");
            at += 9 + length;
            if (chunk == 0 && (opcode == Opcode::data_end || opcode == Opcode::footer)) return {};
            if (auto done = read_record(opcode, content, chunk > 0); !done) return done;
        }
        return {};
    }

    Expected<void> read_record(Opcode opcode, std::string_view bytes, bool in_chunk) {
        Content content(bytes);
        switch (opcode) {
            case Opcode::schema: {
                const auto number = content.number<std::uint16_t>();
                Schema schema;
                schema.name = content.text();
                schema.encoding = content.text();
                schema.text = content.text();
                if (!content.is_whole()) return wrong("the schema record is incomplete");
                if (number == 0) return wrong("a schema can't have the number 0");
                schemas_[number] = std::move(schema);
                return {};
            }
            case Opcode::channel: return read_channel(content);
            case Opcode::message: return read_message(content);
            case Opcode::chunk:
                if (in_chunk) return wrong("a chunk can't be in a chunk");
                return read_chunk(content);
            default:
                if (static_cast<std::uint8_t>(opcode) == 0) return wrong("there is no record of the kind 0");
                return {};
        }
    }

    Expected<void> read_channel(Content& content) {
        const auto number = content.number<std::uint16_t>();
        const auto schema = content.number<std::uint16_t>();
        RecordedChannel channel;
        channel.topic = content.text();
        channel.encoding = content.text();
        Content entries(content.text());
        while (!entries.empty()) {
            const std::string_view key = entries.text();
            channel.metadata.emplace(key, entries.text());
        }
        if (!content.is_whole() || !entries.is_whole()) return wrong("the channel record is incomplete");
        if (schema != 0) {
            const auto known = schemas_.find(schema);
            if (known == schemas_.end())
                return wrong(
                    fmt::format("channel '{}' refers to schema {}, but the file has no such schema before this channel",
                                shown(channel.topic), schema));
            channel.schema = known->second;
        }
        file_.channels[number] = std::move(channel);
        return {};
    }

    Expected<void> read_message(Content& content) {
        RecordedMessage message;
        message.channel = content.number<std::uint16_t>();
        content.number<std::uint32_t>();
        message.log_time = content.number<std::uint64_t>();
        message.publish_time = content.number<std::uint64_t>();
        message.data = content.rest();
        if (!content.is_whole()) return wrong("the message is incomplete");
        if (!file_.channels.contains(message.channel))
            return wrong(fmt::format("the message is of channel {}, but the file has no such channel before it",
                                     message.channel));
        total_ += message.data.size();
        if (total_ > most_recorded_bytes) return wrong("the messages have more than 4 GB");
        file_.messages.push_back(std::move(message));
        return {};
    }

    Expected<void> read_chunk(Content& content) {
        content.number<std::uint64_t>();
        content.number<std::uint64_t>();
        const auto size = content.number<std::uint64_t>();
        const auto expected = content.number<std::uint32_t>();
        const std::string_view compression = content.text();
        const std::string_view packed = content.take(content.number<std::uint64_t>());
        if (!content.is_whole()) return wrong("the chunk is incomplete");
        if (size > most_chunk_bytes) return wrong("the chunk has more than 256 MB");
        std::optional<std::string> unpacked;
        std::string_view records = packed;
        if (compression == "zstd" || compression == "lz4") {
            unpacked = compression == "zstd" ? unpack_zstd(packed, size) : unpack_lz4(packed, size);
            if (!unpacked) return wrong(fmt::format("the chunk is not {} data of {} bytes", compression, size));
            records = *unpacked;
        } else if (!compression.empty()) {
            return wrong(fmt::format("unknown compression '{}': expected zstd, lz4 or none", shown(compression)));
        }
        if (expected != 0 && crc32_z(0, reinterpret_cast<const Bytef*>(records.data()), records.size()) != expected)
            return wrong("the chunk's checksum differs: the file is damaged");
        return read_records(records, 0, here_);
    }

    Unexpected wrong(const std::string& what) const {
        return failure(fmt::format("byte {}: {}", here_, what), {name_});
    }

    const std::string& name_;
    McapFile file_;
    std::map<std::uint16_t, Schema> schemas_;
    std::size_t here_ = 0;   // [bytes] position in the file, for errors
    std::size_t total_ = 0;  // [bytes] of all messages
};

}  // namespace

bool is_mcap(std::string_view bytes) { return bytes.starts_with(mcap_magic); }

Expected<McapFile> read_mcap(std::string_view bytes, const std::string& name) { return McapReader(name).read(bytes); }

}  // namespace nezumi::record
