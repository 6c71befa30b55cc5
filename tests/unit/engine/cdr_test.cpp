// CDR: streams written by hand from the specification, every type there and back, and what is refused.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "engine/ports/payload.hpp"
#include "engine/values/cdr.hpp"
#include "engine/values/plain_data.hpp"

using namespace nezumi;

namespace {

constexpr CdrFormat little{};
constexpr CdrFormat big{.order = std::endian::big};
constexpr CdrFormat with_header{.header = true};

// "01 00 2a" as bytes.
Octets bytes(const std::string& hex) {
    Octets result;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 3) {
        result.push_back(static_cast<std::uint8_t>(std::stoi(hex.substr(i, 2), nullptr, 16)));
    }
    return result;
}

std::string hex(const Octets& data) {
    std::string text;
    for (const std::uint8_t byte : data) text += fmt::format("{:02x} ", byte);
    if (!text.empty()) text.pop_back();
    return text;
}

template <class T>
std::string written(const T& value, const CdrFormat& format = little) {
    Octets out;
    write_cdr(out, format, value);
    return hex(out);
}

template <class T>
std::string error_of(const std::string& stream, const CdrFormat& format = little) {
    T value{};
    const Octets data = bytes(stream);
    const auto read = read_cdr(data, format, value);
    return read ? "" : describe(read.error());
}

// A structure with every alignment in an order that needs padding.
struct Mixed {
    bool flag = false;
    std::int32_t number = 0;
    std::string text;
    double value = 0;
    std::vector<double> values;
    std::int16_t last = 0;
    bool operator==(const Mixed&) const = default;

    static constexpr FieldList fields{
        Field{"flag", &Mixed::flag, "", ""},     Field{"number", &Mixed::number, "", ""},
        Field{"text", &Mixed::text, "", ""},     Field{"value", &Mixed::value, "", ""},
        Field{"values", &Mixed::values, "", ""}, Field{"last", &Mixed::last, "", ""},
    };
};

// Random values of every type: lengths 0 to 4, so that each alignment is met.
class Random {
public:
    explicit Random(unsigned seed) : engine_(seed) {}

    void fill(const ValuePlace& value) {
        switch (value.type->kind) {
            case Type::Kind::structure:
                for (const Type::Field& field : value.type->fields) fill(value.field(field));
                return;
            case Type::Kind::sequence:
                value.resize(length());
                for_each_element(value, [&](const ValuePlace& element) {
                    fill(element);
                    return true;
                });
                return;
            case Type::Kind::text: {
                std::string text(length(), ' ');
                for (char& each : text) each = static_cast<char>(engine_());
                value.as<std::string>() = text;
                return;
            }
            case Type::Kind::octets:
                value.as<Octets>().resize(length());
                for (std::uint8_t& each : value.as<Octets>()) each = static_cast<std::uint8_t>(engine_());
                return;
            case Type::Kind::boolean: value.as<bool>() = engine_() % 2 == 1; return;
            default:
                visit_number(value, [&]<class T>(T& number) {
                    if constexpr (std::is_floating_point_v<T>) {
                        number = static_cast<T>(std::uniform_real_distribution<double>(-1e6, 1e6)(engine_));
                    } else {
                        number = static_cast<T>(engine_());
                    }
                });
        }
    }
    Value payload(const MessageType* type) {
        Value made = make_payload(type);
        fill(made);
        return made;
    }

private:
    std::size_t length() { return engine_() % 5; }
    std::mt19937_64 engine_;
};

}  // namespace

TEST_CASE("a number is written with its bytes in the order that the format says", "[engine][cdr]") {
    CHECK(written(std::int16_t{258}) == "02 01");
    CHECK(written(std::int16_t{258}, big) == "01 02");
    CHECK(written(std::int32_t{-2}) == "fe ff ff ff");
    CHECK(written(1.5F) == "00 00 c0 3f");
    CHECK(written(-1.0) == "00 00 00 00 00 00 f0 bf");
    CHECK(written(-1.0, big) == "bf f0 00 00 00 00 00 00");
    CHECK(written(true) == "01");
    CHECK(written(false, with_header) == "00 01 00 00 00");
    CHECK(written(true, {.order = std::endian::big, .header = true}) == "00 00 00 00 01");
}

TEST_CASE("a message begins with its stamp in seconds and nanoseconds", "[engine][cdr]") {
    Octets out;
    write_cdr_message(out, Velocity2D{.vx = 1, .va = -2}, 3.25);
    CHECK(hex(out) ==
          "03 00 00 00 80 b2 e6 0e "
          "00 00 00 00 00 00 f0 3f 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 c0");
    write_cdr_message(out, std::int16_t{-1}, 1e-9, with_header);
    CHECK(hex(out) == "00 01 00 00 00 00 00 00 01 00 00 00 ff ff");
}

TEST_CASE("a text counts its final 0", "[engine][cdr]") {
    CHECK(written(std::string("abc")) == "04 00 00 00 61 62 63 00");
    CHECK(written(std::string()) == "01 00 00 00 00");
    CHECK(written(std::string("ab"), big) == "00 00 00 03 61 62 00");
}

TEST_CASE("after a text of any length the next one's length is aligned, after the last one nothing", "[engine][cdr]") {
    CHECK(written(std::vector<std::string>{"a", "abc", ""}) ==
          "03 00 00 00 02 00 00 00 61 00 00 00 04 00 00 00 61 62 63 00 01 00 00 00 00");
}

TEST_CASE("a sequence's length is padded to its elements, unless there are none", "[engine][cdr]") {
    CHECK(written(std::vector<double>{1}) == "01 00 00 00 00 00 00 00 00 00 00 00 00 00 f0 3f");
    CHECK(written(std::vector<double>{}) == "00 00 00 00");
    CHECK(written(std::vector<std::int16_t>{1, -1}) == "02 00 00 00 01 00 ff ff");
    CHECK(written(std::vector<std::int16_t>{1, -1}, big) == "00 00 00 02 00 01 ff ff");
    CHECK(written(std::vector<bool>{true, false, true}) == "03 00 00 00 01 00 01");
    CHECK(written(Octets{7, 8}, big) == "00 00 00 02 07 08");
}

TEST_CASE("fields are aligned from the start of the stream, behind its header", "[engine][cdr]") {
    const Mixed mixed{true, 2, "hello", 1, {}, 3};
    const std::string body =
        "01 00 00 00 02 00 00 00 06 00 00 00 68 65 6c 6c 6f 00 00 00 00 00 00 00 "
        "00 00 00 00 00 00 f0 3f 00 00 00 00 03 00";
    CHECK(written(mixed) == body);
    CHECK(written(mixed, with_header) == "00 01 00 00 " + body);
    CHECK(written(mixed, big) ==
          "01 00 00 00 00 00 00 02 00 00 00 06 68 65 6c 6c 6f 00 00 00 00 00 00 00 "
          "3f f0 00 00 00 00 00 00 00 00 00 00 00 03");
    // An empty sequence of doubles brings no padding; one with an element does.
    CHECK(written(Mixed{false, 0, "", 0, {1}, 3}) ==
          "00 00 00 00 00 00 00 00 01 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 "
          "01 00 00 00 00 00 00 00 00 00 00 00 00 00 f0 3f 03 00");
}

TEST_CASE("a picture travels as OpenRTM's CameraImage", "[engine][cdr]") {
    Octets out;
    write_cdr_message(
        out, CameraImage{.width = 2, .height = 1, .bpp = 8, .format = "gray8", .fDiv = 1, .pixels = {9, 10}}, 0);
    CHECK(hex(out) ==
          "00 00 00 00 00 00 00 00 02 00 01 00 08 00 00 00 06 00 00 00 67 72 61 79 38 00 00 00 00 00 00 00 "
          "00 00 00 00 00 00 f0 3f 02 00 00 00 09 0a");
}

TEST_CASE("nested structures are their fields, sequences of them too", "[engine][cdr]") {
    RangeData range{.ranges = {0.5}};
    range.geometry.elements.resize(2);
    range.geometry.elements[1].size.h = 1;
    Octets out;
    write_cdr(out, little, range);
    // ranges 16, geometry 72, its elements 4 + padding 4 + 2 * 72, config 56.
    REQUIRE(out.size() == 16 + 72 + 8 + 2 * 72 + 56);
    const auto at = [&](std::size_t begin) {
        return hex(Octets(out.begin() + static_cast<long>(begin), out.begin() + static_cast<long>(begin + 8)));
    };
    CHECK(at(0) == "01 00 00 00 00 00 00 00");
    CHECK(at(8) == "00 00 00 00 00 00 e0 3f");
    CHECK(at(88) == "02 00 00 00 00 00 00 00");
    CHECK(at(96 + 2 * 72 - 8) == "00 00 00 00 00 00 f0 3f");
}

TEST_CASE("every type comes back as it was, in both orders, with and without the header", "[engine][cdr]") {
    Random random(1);
    for (int round = 0; round < 200; ++round) {
        for (const MessageType& each : compiled_message_types()) {
            const MessageType* const type = &each;
            const Value sent = random.payload(type);
            for (const CdrFormat& format : {little, big, with_header, CdrFormat{std::endian::big, true}}) {
                Octets out;
                write_cdr_message(out, sent, 12.34, format);
                // What the memory held before doesn't matter.
                Value got = random.payload(type);
                double tm = 0;
                // Who reads a stream with a header needn't know its order.
                const auto read = read_cdr_message(out, got, tm, format.header ? with_header : format);
                INFO(type->name << ' ' << hex(out) << ' ' << (read ? "" : read.error().message));
                REQUIRE(read.has_value());
                REQUIRE(got == sent);
                REQUIRE(tm == 12.34);
            }
        }
    }
}

TEST_CASE("a stamp with up to nine decimals comes back exactly, any other to the nearest nanosecond", "[engine][cdr]") {
    CHECK(to_cdr_time(0.07) == CdrTime{0, 70'000'000});
    CHECK(to_cdr_time(1.9999999999) == CdrTime{2, 0});
    for (int i = 0; i < 200'000; ++i) {
        REQUIRE(to_seconds(to_cdr_time(i / 100.0)) == i / 100.0);
        REQUIRE(std::abs(to_seconds(to_cdr_time(i / 30.0)) - i / 30.0) < 6e-10);
    }
    CHECK(to_seconds({9'007'190, 1}) == 9'007'190.000000001);
    // The seconds of today's clocks: what a double holds of them.
    CHECK(to_seconds(to_cdr_time(1'700'000'000.123456)) == 1'700'000'000.123456);
    CHECK(to_seconds({1, 1'500'000'000}) == 2.5);
}

TEST_CASE("a stamp out of range becomes the nearest that can be written", "[engine][cdr]") {
    CHECK(to_cdr_time(-1) == CdrTime{0, 0});
    CHECK(to_cdr_time(std::numeric_limits<double>::quiet_NaN()) == CdrTime{0, 0});
    CHECK(to_cdr_time(1e300) == CdrTime{4'294'967'295, 999'999'999});
    CHECK(to_cdr_time(4'294'967'295.0) == CdrTime{4'294'967'295, 0});
}

TEST_CASE("a truncated message is refused at every length", "[engine][cdr]") {
    Random random(2);
    for (const MessageType& each : compiled_message_types()) {
        const MessageType* const type = &each;
        const Value sent = random.payload(type);
        Octets out;
        write_cdr_message(out, sent, 1);
        for (std::size_t size = 0; size < out.size(); ++size) {
            Value got = sent;
            double tm = -1;
            const auto read = read_cdr_message(std::span(out).first(size), got, tm);
            INFO(type->name << " of " << out.size() << " bytes cut to " << size);
            REQUIRE_FALSE(read.has_value());
            REQUIRE(tm == -1);
        }
    }
}

TEST_CASE("an error has the byte, the field, the expected and the found value", "[engine][cdr]") {
    CHECK(error_of<Velocity2D>("00 00 00 00 00 00 f0 3f 00 00 00") ==
          "byte 8, field 'vy': expected 8 bytes, 3 are left");
    CHECK(error_of<Pose2D>("00 00 00 00 00 00 f0 3f 00 00 00 00 00 00 f0 3f") ==
          "byte 16, field 'heading': expected 8 bytes, 0 are left");
    CHECK(error_of<std::int16_t>("01") == "byte 0: expected 2 bytes, 1 are left");
    CHECK(error_of<bool>("02") == "byte 0: expected a boolean (0 or 1), got 2");
    CHECK(error_of<std::vector<bool>>("02 00 00 00 01 ff") == "byte 5: expected a boolean (0 or 1), got 255");
    CHECK(error_of<std::string>("00 00 00 00") ==
          "byte 0: expected a string length of 1 or more (it includes the final 0), got 0");
    CHECK(error_of<std::string>("02 00 00 00 61 62") == "byte 5: expected the final 0 of a string, got 98");
    CHECK(error_of<std::string>("03 00 00 00 61 00") ==
          "byte 0: expected 3 elements of at least 1 bytes, 2 bytes are left");
    CHECK(error_of<std::int16_t>("01 00 00") == "byte 2: expected the end, got 1 more bytes");
    CHECK(error_of<CameraImage>("01 00 01 00 08 00 00 00 01 00 00 00 01") ==
          "byte 12, field 'format': expected the final 0 of a string, got 1");
    // The padding before a number may be missing as well.
    CHECK(error_of<std::vector<double>>("01 00 00 00 00 00 00 00 00 00 00 00") ==
          "byte 8: expected 8 bytes, 4 are left");
    // The stamp's fields are not the payload's.
    std::int16_t value = 0;
    double tm = 0;
    CHECK(read_cdr_message(bytes("00 00 00 00 00 00 00 00 01"), value, tm).error().message ==
          "byte 8: expected 2 bytes, 1 are left");
    CHECK(read_cdr_message(bytes("00 00 00 00 00 00"), value, tm).error().message ==
          "byte 4, field 'nsec': expected 4 bytes, 2 are left");
}

TEST_CASE("a length that the stream can't hold is refused before anything is allocated", "[engine][cdr]") {
    const std::string huge = "ff ff ff ff 00 00 00 00";
    CHECK(error_of<std::vector<double>>(huge) ==
          "byte 0: expected 4294967295 elements of at least 8 bytes, 4 bytes are left");
    CHECK(error_of<Octets>(huge) == "byte 0: expected 4294967295 elements of at least 1 bytes, 4 bytes are left");
    CHECK(error_of<std::vector<std::string>>(huge) ==
          "byte 0: expected 4294967295 elements of at least 5 bytes, 4 bytes are left");
    CHECK(error_of<std::vector<RangerElement>>(huge) ==
          "byte 0: expected 4294967295 elements of at least 72 bytes, 4 bytes are left");
    CHECK(error_of<std::string>(huge) == "byte 0: expected 4294967295 elements of at least 1 bytes, 4 bytes are left");
}

TEST_CASE("only plain CDR's headers are taken, and padding only behind one", "[engine][cdr]") {
    CHECK(error_of<bool>("00 01 00", with_header) == "byte 0: expected 4 bytes, 3 are left");
    CHECK(error_of<bool>("00 03 00 00 01", with_header) ==
          "byte 0: expected the header of plain CDR (00 00 or 00 01), got 00 03");
    CHECK(error_of<bool>("01 01 00 00 01", with_header) ==
          "byte 0: expected the header of plain CDR (00 00 or 00 01), got 01 01");
    // XTypes counts the padding in the header's last byte, older peers leave it 0.
    CHECK(error_of<bool>("00 01 00 03 01 00 00 00", with_header).empty());
    CHECK(error_of<bool>("00 01 00 00 01 00 00 00", with_header).empty());
    CHECK(error_of<bool>("00 01 00 00 01 00 00 00 00", with_header) == "byte 5: expected the end, got 4 more bytes");
    CHECK(error_of<bool>("01 00") == "byte 1: expected the end, got 1 more bytes");
}

TEST_CASE("a stream of more than 64 MiB is refused unread", "[engine][cdr]") {
    const Octets data(most_cdr_bytes + 1);
    Octets value;
    const auto read = read_cdr(data, little, value);
    REQUIRE_FALSE(read.has_value());
    CHECK(read.error().message == "byte 0: expected at most 67108864 bytes, got 67108865");
}

namespace {

// An array of IDL, as ROS has them: without its length.
struct Matrix {
    std::uint8_t before = 0;
    std::array<double, 2> rows{};
    bool operator==(const Matrix&) const = default;

    static constexpr FieldList fields{Field{"before", &Matrix::before, "", ""}, Field{"rows", &Matrix::rows, "", ""}};
};

}  // namespace

TEST_CASE("plain data is each value's type in a byte and the value, and comes back with its shape", "[engine][cdr]") {
    PlainData data;
    data.values = {Value(), true, std::int64_t{-2}, 0.5, "a", TableRef{0}, std::vector<double>{1.5}};
    data.tables = {{{"self", TableRef{0}}, {false, std::vector<std::string>{"x"}}}};
    Octets stream;
    write_cdr(stream, with_header, data);
    PlainData back;
    REQUIRE(read_cdr(stream, with_header, back));
    CHECK(back == data);
    CHECK(is_sound(back));
    CHECK(written(std::vector<Value>{true, Value()}) == "02 00 00 00 01 01 00");
    CHECK(error_of<std::vector<Value>>("01 00 00 00 63") ==
          "byte 4: expected the number of a type, from 0 to 9, got 99");
    back.tables[0][0][1] = TableRef{1};
    CHECK_FALSE(is_sound(back));
    back.tables[0][0] = {Value(), 1.0};
    CHECK_FALSE(is_sound(back));
}

TEST_CASE("an array of a fixed size has no length before it", "[engine][cdr]") {
    const Matrix matrix{7, {1.0, -2.0}};
    CHECK(written(matrix) == "07 00 00 00 00 00 00 00 00 00 00 00 00 00 f0 3f 00 00 00 00 00 00 00 c0");
    Octets out;
    write_cdr(out, big, std::vector<Matrix>{matrix, matrix});
    std::vector<Matrix> back;
    REQUIRE(read_cdr(out, big, back).has_value());
    CHECK(back == std::vector<Matrix>{matrix, matrix});
    out.pop_back();
    CHECK_FALSE(read_cdr(out, big, back).has_value());
}
