// MCAP files: written in pieces, cut off, damaged, and written by another program (tests/unit/record/others, made with
// @mcap/core 2 from npm).
#include <catch2/catch.hpp>

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "bindings/record/mcap_reader.hpp"
#include "bindings/record/mcap_writer.hpp"
#include "bindings/record/recorded_run.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/messages/message_coding.hpp"

using namespace nezumi;
using namespace nezumi::record;

namespace {

RecordedChannel distance() {
    return {.topic = "/distance",
            .encoding = "cdr",
            .schema = {"std_msgs/msg/Int16", "ros2msg", "int16 data\n"},
            .metadata = {{"nezumi_port", "it.distance"}}};
}

RecordedMessage message(std::uint16_t channel, std::uint64_t log_time, std::string data) {
    return {channel, log_time, log_time / 2, std::move(data)};
}

McapFile read_well(const std::string& bytes) {
    auto file = read_mcap(bytes, "x.mcap");
    REQUIRE(file);
    return std::move(*file);
}

std::string error_of(const std::string& bytes) {
    const auto file = read_mcap(bytes, "x.mcap");
    REQUIRE_FALSE(file);
    return describe(file.error());
}

std::vector<std::string> data_of(const McapFile& file) {
    std::vector<std::string> all;
    for (const RecordedMessage& each : file.messages) all.push_back(each.data);
    return all;
}

// A file of one whole chunk with two messages, and where its chunk begins.
struct Sample {
    McapWriter writer;
    std::string begin = writer.begin();
    std::string end;
    Sample() {
        writer.add({{{0, distance()}}, {message(0, 10, "first"), message(0, 20, "second")}});
        end = writer.end();
    }
    std::string file() const { return begin + end; }
};

}  // namespace

TEST_CASE("an MCAP file is read back as it was written: channels, schemas, times and messages", "[record]") {
    const McapFile file = read_well(Sample().file());
    CHECK(file.is_complete);
    REQUIRE(file.channels.size() == 1);
    const RecordedChannel& channel = file.channels.at(0);
    CHECK(channel.topic == "/distance");
    CHECK(channel.encoding == "cdr");
    CHECK(channel.schema == distance().schema);
    CHECK(channel.metadata == distance().metadata);
    REQUIRE(file.messages.size() == 2);
    CHECK(file.messages[1].log_time == 20);
    CHECK(file.messages[1].publish_time == 10);
    CHECK(data_of(file) == std::vector<std::string>{"first", "second"});
}

TEST_CASE("small chunks are complete by themselves, and a whole chunk replaces them", "[record]") {
    McapWriter writer;
    const std::string begin = writer.begin();
    writer.add({{{0, distance()}}, {message(0, 10, "first")}});
    const std::string one = writer.small_chunk();
    writer.add({{}, {message(0, 20, "second")}});
    const std::string two = writer.small_chunk();
    CHECK(writer.small_chunk().empty());
    const McapFile killed = read_well(begin + one + two);
    CHECK_FALSE(killed.is_complete);
    CHECK(data_of(killed) == std::vector<std::string>{"first", "second"});

    const std::string whole = writer.whole_chunk();
    CHECK(data_of(read_well(begin + whole)) == std::vector<std::string>{"first", "second"});
    writer.add({{}, {message(0, 30, "third")}});
    const std::string three = writer.small_chunk();
    CHECK(data_of(read_well(begin + whole + three)) == std::vector<std::string>{"first", "second", "third"});
    const McapFile complete = read_well(begin + whole + writer.end());
    CHECK(complete.is_complete);
    CHECK(data_of(complete) == std::vector<std::string>{"first", "second", "third"});
}

TEST_CASE("a file that was cut off at any byte gives the messages of its complete chunks", "[record]") {
    McapWriter writer;
    const std::string begin = writer.begin();
    writer.add({{{0, distance()}}, {message(0, 10, "first")}});
    const std::string one = writer.small_chunk();
    writer.add({{}, {message(0, 20, "second")}});
    const std::string all = begin + one + writer.small_chunk();
    for (std::size_t length = begin.size(); length <= all.size(); ++length) {
        const McapFile file = read_well(all.substr(0, length));
        const std::size_t expected = length == all.size() ? 2 : length >= begin.size() + one.size() ? 1 : 0;
        REQUIRE(file.messages.size() == expected);
    }
}

TEST_CASE("files of another program are read: without chunks, with plain chunks and with lz4", "[record]") {
    const std::string name = GENERATE("unchunked", "plain", "lz4");
    const std::string path = "tests/unit/record/others/" + name + ".mcap";
    const McapFile file = read_well(read_whole(path, path).value());
    CHECK(file.is_complete);
    const RecordedChannel& channel = file.channels.begin()->second;
    CHECK(channel.topic == "/distance");
    CHECK(channel.metadata.at("from") == "elsewhere");
    CHECK(channel.schema.text == "int16 data\n");
    // By log time, whatever their order in the file is.
    REQUIRE(file.messages.size() == 3);
    CHECK(file.messages[0].log_time == 100);
    CHECK(file.messages[0].publish_time == 50);
    CHECK(file.messages[0].data == std::string("\0\1\0\0\x08\0", 6));
    CHECK(file.messages[2].log_time == 300);
}

TEST_CASE("a damaged MCAP file is refused in one line with the byte", "[record]") {
    const Sample sample;
    const std::size_t chunk = sample.begin.size();
    const auto with = [&](std::size_t at, const std::string& bytes) {
        return sample.file().replace(chunk + at, bytes.size(), bytes);
    };
    const std::string where = "x.mcap: byte " + std::to_string(chunk) + ": ";
    CHECK(error_of("# a text") == "x.mcap: is not an MCAP file");
    CHECK(error_of(with(1, "\xff\xff\xff\xff\xff\xff\xff\x7f")) ==
          where + "the record is longer than the file or its chunk");
    CHECK(error_of(with(9 + 24, "\1\2\3\4")) == where + "the chunk's checksum differs: the file is damaged");
    CHECK(error_of(with(9 + 16, std::string("\0\0\0\x40", 4))) == where + "the chunk has more than 256 MB");
    CHECK(error_of(with(9 + 16, "\1")) == where + "the chunk is not zstd data of 1 bytes");
    CHECK(error_of(with(9 + 32, "zztd")) == where + "unknown compression 'zztd': expected zstd, lz4 or none");
    CHECK(error_of(with(9 + 28, "\xff\xff")) == where + "the chunk is incomplete");
    CHECK(error_of(with(0, std::string(1, '\0'))) == where + "there is no record of the kind 0");
}

TEST_CASE("a message without a channel and a channel without its schema are refused", "[record]") {
    McapWriter writer;
    const std::string begin = writer.begin();
    writer.add({{}, {message(3, 10, "lost")}});
    CHECK(error_of(begin + writer.end())
              .find("the message is of channel 3, but the file has no such channel before it") != std::string::npos);

    std::string unchunked = read_whole("tests/unit/record/others/unchunked.mcap", "x").value();
    const std::size_t channel = unchunked.find("/distance") - 4 - 2;  // the number of its schema
    unchunked[channel] = 9;
    CHECK(error_of(unchunked).find(
              "channel '/distance' refers to schema 9, but the file has no such schema before this channel") !=
          std::string::npos);
}

TEST_CASE("a recording without a journal says that its run can't be repeated", "[record]") {
    const auto journal = journal_of(read_well(Sample().file()), "x.mcap");
    REQUIRE_FALSE(journal);
    CHECK(describe(journal.error()) ==
          "x.mcap: has no /nezumi/journal: nezumi run --record did not write it, so the run can't be repeated");
    McapFile cut = read_well(Sample().file());
    cut.is_complete = false;
    CHECK(describe(journal_of(cut, "x.mcap").error()) ==
          "x.mcap: has no /nezumi/journal: it was cut off before that, or nezumi run --record did not write it, so the "
          "run can't be repeated");
}

TEST_CASE("seconds with nine decimals come back from nanoseconds exactly", "[record]") {
    for (const double seconds : {0.0, 0.01, 0.07, 0.29, 1.15, 123456.789, 1e6 + 1e-9})
        CHECK(to_seconds(to_nanoseconds(seconds)) == seconds);
    CHECK(to_nanoseconds(-1) == 0);
    CHECK(to_nanoseconds(std::numeric_limits<double>::quiet_NaN()) == 0);
}
