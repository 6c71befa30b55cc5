// Messages and described structures as plain CDR, the wire format of CORBA and DDS (OMG CORBA 3.4 part 2, 9.3; XTypes
// 1.3, 7.4.1).
//
// A number is aligned to its size, counted from the start of the stream. A boolean is one byte. A text is its length
// (with the final 0) in 4 bytes, its bytes and a 0. A sequence is its length in 4 bytes and its elements. An array is
// its elements, a structure its fields in order, a choice of an enumeration its index in 4 bytes. A value of any type
// is the index of its type in `plain_types` in one byte, then the value. Padding is 0, so equal values give equal
// bytes.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/values/view.hpp"

namespace nezumi {

/// Properties of a stream that writer and reader must agree on.
struct CdrFormat {
    std::endian order = std::endian::little;
    /// The stream begins with the 4 bytes of RTPS (0, then 1 for little or 0 for big endian, 0, 0). Alignment counts
    /// after them. A reader takes the byte order from them, and accepts up to 3 bytes of padding at the end: DDS pads
    /// to a multiple of 4.
    bool header = false;
};

/// The largest stream [bytes]. A larger one is refused before it is read.
inline constexpr std::size_t most_cdr_bytes = std::size_t{64} << 20;

/// A stamp in a stream: `RTC::Time` of OpenRTM-aist. In streams of other programs, `nsec` may be 10^9 or more.
struct CdrTime {
    std::uint32_t sec = 0;
    std::uint32_t nsec = 0;
    bool operator==(const CdrTime&) const = default;

    static constexpr std::string_view type_name = "Time";
    static constexpr FieldList fields{Field{"sec", &CdrTime::sec, "s", "whole seconds"},
                                      Field{"nsec", &CdrTime::nsec, "ns", "the rest"}};
};

/// Rounds to the nearest nanosecond. Negative values and NaN become 0, too large values the largest time.
CdrTime to_cdr_time(double seconds);
/// The inverse: a number of seconds with at most 9 decimals comes back exactly.
double to_seconds(const CdrTime& time);

namespace detail {

/// Appends values to a stream.
class CdrWriter {
public:
    CdrWriter(Octets& out, const CdrFormat& format);

    void write(const ValueView& value);

private:
    void write_any(const Value& value);
    void write_elements(const ValueView& value);
    void write_length(std::size_t length);
    void write_bytes(const void* first, std::size_t size);
    /// Appends padding for alignment, then `count` numbers of `each` bytes.
    void write_numbers(std::size_t each, const void* first, std::size_t count);

    Octets& out_;
    std::size_t origin_ = 0;
    bool swap_;
};

/// Reads values from a stream. After the first error it reads nothing more.
class CdrReader {
public:
    CdrReader(std::span<const std::uint8_t> bytes, const CdrFormat& format);

    void read(const ValuePlace& value);
    /// Returns the first error, or an error if more than padding is left.
    Expected<void> finish();

private:
    void read_any(Value& value);
    void read_elements(const ValuePlace& value);
    void read_sequence(const ValuePlace& value);
    void read_numbers(std::size_t each, void* first, std::size_t count);
    /// Skips padding for alignment and returns the next `size` bytes, or null.
    const std::uint8_t* take(std::size_t alignment, std::size_t size);
    /// Reads the length of a sequence or text. An error, and 0, if so many elements of at least `element_size` bytes do
    /// not fit in the remaining bytes.
    std::size_t read_length(std::size_t element_size);
    bool read_truth();
    void read_choice(const ValuePlace& value);
    void read_text(std::string& text);
    void read_octets(Octets& octets);
    void fail(std::size_t at, const std::string& what);

    std::span<const std::uint8_t> bytes_;
    std::size_t at_ = 0;
    std::size_t origin_ = 0;
    std::size_t padding_ = 0;  // how many bytes may be left at the end
    bool swap_ = false;
    std::string_view field_;
    std::optional<Error> error_;
};

}  // namespace detail

/// Replaces `out` by the stream of these values in order, like the fields of a structure.
template <class... T>
void write_cdr(Octets& out, const CdrFormat& format, const T&... values) {
    out.clear();
    detail::CdrWriter writer(out, format);
    (writer.write(values), ...);
}

/// Reads a stream with exactly these values. Allocates at most a small multiple of the stream's size. Numbers may be
/// infinite or NaN. An error has the byte, from 0, and the field; the values are then invalid.
template <class... T>
Expected<void> read_cdr(std::span<const std::uint8_t> bytes, const CdrFormat& format, T&&... values) {
    detail::CdrReader reader(bytes, format);
    (reader.read(values), ...);
    return reader.finish();
}

/// Replaces `out` by a message: its stamp `tm` [s], then its payload.
void write_cdr_message(Octets& out, const ValueView& data, double tm, const CdrFormat& format = {});

/// Reads a message like `read_cdr`; reuses the memory of `data`.
Expected<void> read_cdr_message(std::span<const std::uint8_t> bytes, const ValuePlace& data, double& tm,
                                const CdrFormat& format = {});

}  // namespace nezumi
