// Messages and described structures as plain CDR, the wire format of CORBA and DDS (OMG CORBA 3.4 part 2, 9.3; XTypes
// 1.3, 7.4.1).
//
// A number is aligned to its size, counted from the start of the stream. A truth value is one byte, a text its length
// (with the final 0), its bytes and a 0, a sequence its length and its elements, an array its elements, a structure its
// fields in order. What is written is a function of the value alone: padding is 0.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/ports/describe.hpp"
#include "engine/ports/messages.hpp"

namespace nezumi {

/// What both sides of a stream must agree on.
struct CdrFormat {
    std::endian order = std::endian::little;
    /// Begins with the 4 bytes of RTPS (0, 1 for little or 0 for big endian, 0, 0). Alignment counts from behind them.
    /// When reading, they decide the order, and up to 3 bytes of padding may follow: DDS pads to a multiple of 4.
    bool header = false;
};

/// A stream that is longer than these bytes is refused before anything of it is read.
inline constexpr std::size_t most_cdr_bytes = std::size_t{64} << 20;

/// A stamp as it travels: `RTC::Time` of OpenRTM-aist. A peer's `nsec` may be 10^9 or more.
struct CdrTime {
    std::uint32_t sec = 0;
    std::uint32_t nsec = 0;
    bool operator==(const CdrTime&) const = default;
};

template <>
struct Describe<CdrTime> {
    static constexpr std::string_view name = "Time";
    static constexpr std::tuple fields{Field{"sec", &CdrTime::sec, "s", "whole seconds"},
                                       Field{"nsec", &CdrTime::nsec, "ns", "the rest"}};
};

/// To the nearest nanosecond; what is negative, not a number or too large becomes the nearest end of the range.
CdrTime to_cdr_time(double seconds);
/// The inverse: a number of seconds with at most 9 decimals comes back exactly.
double to_seconds(const CdrTime& time);

namespace detail {

/// So many of the same, without their number: an array of IDL.
template <class T>
struct IsArray : std::false_type {};
template <class T, std::size_t N>
struct IsArray<std::array<T, N>> : std::true_type {};

/// The fewest bytes that a T takes in a stream.
template <class T>
constexpr std::size_t min_cdr_size() {
    if constexpr (Described<T>) {
        return std::apply([]<class... M>(const Field<T, M>&...) { return (std::size_t{0} + ... + min_cdr_size<M>()); },
                          Describe<T>::fields);
    } else if constexpr (IsArray<T>::value) {
        return std::tuple_size_v<T> * min_cdr_size<typename T::value_type>();
    } else if constexpr (std::is_same_v<T, bool>) {
        return 1;
    } else if constexpr (std::is_arithmetic_v<T>) {
        return sizeof(T);
    } else if constexpr (std::is_same_v<T, std::string>) {
        return sizeof(std::uint32_t) + 1;
    } else {
        return sizeof(std::uint32_t);
    }
}

template <class T>
concept CdrNumber = std::is_arithmetic_v<T> && !std::is_same_v<T, bool> && sizeof(T) <= 8;

template <CdrNumber T>
T swap_bytes(T value) {
    auto bytes = std::bit_cast<std::array<std::uint8_t, sizeof(T)>>(value);
    std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<T>(bytes);
}

/// Appends values to a stream.
class CdrWriter {
public:
    CdrWriter(Octets& out, const CdrFormat& format);

    template <class T>
    void write(const T& value) {
        if constexpr (Described<T>) {
            for_each_field(value, [&](const auto&, const auto& member) { write(member); });
        } else if constexpr (IsArray<T>::value) {
            for (const auto& element : value) write(element);
        } else if constexpr (std::is_same_v<T, bool>) {
            out_.push_back(value ? 1 : 0);
        } else if constexpr (CdrNumber<T>) {
            const T ordered = swap_ ? swap_bytes(value) : value;
            append(sizeof(T), &ordered, sizeof(T));
        } else if constexpr (std::is_same_v<T, std::string>) {
            write_length(value.size() + 1);
            append(1, value.c_str(), value.size() + 1);
        } else {
            write_sequence(value);
        }
    }

private:
    template <class T>
    void write_sequence(const std::vector<T>& sequence) {
        write_length(sequence.size());
        if constexpr (CdrNumber<T>) {
            if (sequence.empty()) return;
            if (!swap_ || sizeof(T) == 1) return append(sizeof(T), sequence.data(), sequence.size() * sizeof(T));
        }
        for (std::size_t i = 0; i < sequence.size(); ++i) write(static_cast<const T&>(sequence[i]));
    }
    void write_length(std::size_t length) {
        assert(length <= std::numeric_limits<std::uint32_t>::max());
        write(static_cast<std::uint32_t>(length));
    }
    /// Appends `size` bytes behind the padding that aligns them.
    void append(std::size_t alignment, const void* data, std::size_t size);

    Octets& out_;
    std::size_t origin_ = 0;
    bool swap_;
};

/// Takes values from a stream. After the first error it takes nothing more.
class CdrReader {
public:
    CdrReader(std::span<const std::uint8_t> bytes, const CdrFormat& format);

    template <class T>
    void read(T& value) {
        if constexpr (Described<T>) {
            for_each_field(value, [&](const auto& field, auto& member) {
                if (error_) return;
                field_ = field.name;
                read(member);
            });
            field_ = {};
        } else if constexpr (IsArray<T>::value) {
            for (auto& element : value) read(element);
        } else if constexpr (std::is_same_v<T, bool>) {
            value = read_truth();
        } else if constexpr (CdrNumber<T>) {
            const std::uint8_t* bytes = take(sizeof(T), sizeof(T));
            if (bytes == nullptr) return;
            std::memcpy(&value, bytes, sizeof(T));
            if (swap_) value = swap_bytes(value);
        } else if constexpr (std::is_same_v<T, std::string>) {
            read_text(value);
        } else {
            read_sequence(value);
        }
    }
    /// Whether all went well and nothing is left but padding.
    Expected<void> finish();

private:
    template <class T>
    void read_sequence(std::vector<T>& sequence) {
        const std::size_t count = read_length(min_cdr_size<T>());
        if constexpr (CdrNumber<T>) {
            const std::uint8_t* bytes = count > 0 ? take(sizeof(T), count * sizeof(T)) : nullptr;
            sequence.resize(bytes != nullptr ? count : 0);
            if (bytes != nullptr) std::memcpy(sequence.data(), bytes, count * sizeof(T));
            if (swap_) std::transform(sequence.begin(), sequence.end(), sequence.begin(), swap_bytes<T>);
        } else {
            sequence.resize(count);
            for (std::size_t i = 0; i < count && !error_; ++i) {
                if constexpr (std::is_same_v<T, bool>) {
                    sequence[i] = read_truth();
                } else {
                    read(sequence[i]);
                }
            }
        }
    }
    /// The next `size` bytes behind the padding that aligns them, or null.
    const std::uint8_t* take(std::size_t alignment, std::size_t size);
    /// A sequence's length, 0 if its elements of at least `element_size` bytes can't be in what is left.
    std::size_t read_length(std::size_t element_size);
    bool read_truth();
    void read_text(std::string& text);
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

/// Replaces `out` by the stream of these values, one after the other as the fields of a structure.
template <class... T>
void write_cdr(Octets& out, const CdrFormat& format, const T&... values) {
    out.clear();
    detail::CdrWriter writer(out, format);
    (writer.write(values), ...);
}

/// Reads a stream that holds exactly these values. Allocates no more than a small multiple of the stream's size.
/// Numbers may be not finite. An error tells the byte, from 0, and the field; the values are then of no use.
template <class... T>
Expected<void> read_cdr(std::span<const std::uint8_t> bytes, const CdrFormat& format, T&... values) {
    detail::CdrReader reader(bytes, format);
    (reader.read(values), ...);
    return reader.finish();
}

/// Replaces `out` by a message: its stamp `tm` [s], then its payload.
template <Payload T>
void write_cdr_message(Octets& out, const T& data, double tm, const CdrFormat& format = {}) {
    write_cdr(out, format, to_cdr_time(tm), data);
}
void write_cdr_message(Octets& out, const AnyPayload& data, double tm, const CdrFormat& format = {});

/// Reads a message as `read_cdr` does; `data` keeps what memory it has.
template <Payload T>
Expected<void> read_cdr_message(std::span<const std::uint8_t> bytes, T& data, double& tm,
                                const CdrFormat& format = {}) {
    CdrTime time;
    Expected<void> read = read_cdr(bytes, format, time, data);
    if (read) tm = to_seconds(time);
    return read;
}
/// The same for the type that `data` holds.
Expected<void> read_cdr_message(std::span<const std::uint8_t> bytes, AnyPayload& data, double& tm,
                                const CdrFormat& format = {});

}  // namespace nezumi
