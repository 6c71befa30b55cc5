// Messages on a stream of bytes: lines, frames of a length, COBS.
#include <catch2/catch.hpp>
#include <random>
#include <string>
#include <vector>

#include "hw/wire/framing.hpp"

using namespace nezumi::hw;
using Messages = std::vector<std::string>;

TEST_CASE("lines are cut at their ends, wherever a reading ends", "[hw][wire]") {
    Framer framer({.end = "\r\n"});
    CHECK(framer.take("e 1 2\r\ne 3").size() == 1);
    CHECK(framer.take(" 4\r") == Messages{});
    CHECK(framer.take("\n\r\n") == Messages{"e 3 4", ""});
    CHECK(framer.encode("v 0 0") == "v 0 0\r\n");
}

TEST_CASE("frames of a length have this length, and others are refused", "[hw][wire]") {
    Framer framer({.length = 3});
    CHECK(framer.take("abcdefg") == Messages{"abc", "def"});
    CHECK(framer.take("hi") == Messages{"ghi"});
    CHECK_FALSE(framer.encode("ab"));
    CHECK(framer.encode("abc") == "abc");
}

TEST_CASE("without an end each reading is a message", "[hw][wire]") {
    Framer framer({});
    CHECK(framer.take("abc") == Messages{"abc"});
    CHECK(framer.take("") == Messages{});
}

TEST_CASE("COBS is as in its paper, and decodes what it encodes", "[hw][wire]") {
    using namespace std::string_literals;
    CHECK(encode_cobs("") == "\1");
    CHECK(encode_cobs("\0"s) == "\1\1");
    CHECK(encode_cobs("\x11\x22\0\x33"s) == "\x03\x11\x22\x02\x33");
    std::mt19937 random(124);
    for (int size = 0; size < 600; ++size) {
        std::string message;
        for (int i = 0; i < size; ++i) message.push_back(static_cast<char>(random() % 5));
        if (size > 300) message.assign(static_cast<std::size_t>(size), 'x');
        const std::string bytes = encode_cobs(message);
        CHECK(bytes.find('\0') == std::string::npos);
        CHECK(decode_cobs(bytes) == message);
    }
    CHECK_FALSE(decode_cobs("\x05\x11"));
}

TEST_CASE("a broken COBS frame is dropped, and the next one is read", "[hw][wire]") {
    using namespace std::string_literals;
    Framer framer({.cobs = true});
    CHECK(framer.take("\x09\x11\0\x02\x41\0\0"s) == Messages{"A"});
}

TEST_CASE("a message that never ends is dropped", "[hw][wire]") {
    Framer framer({.end = "\n"});
    CHECK(framer.take(std::string(Framer::longest + 1, 'x')).empty());
    CHECK(framer.take("e 1 2\n") == Messages{"e 1 2"});
}
