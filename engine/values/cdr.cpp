// Writes and reads values of any type as CDR, by the tables of their types.
#include "engine/values/cdr.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>

#include "engine/values/plain_data.hpp"

namespace nezumi {
namespace {

constexpr std::size_t header_size = 4;
constexpr std::uint32_t nanoseconds = 1'000'000'000;

// The smallest size of a value of this type in a stream [bytes].
std::size_t min_cdr_size(const Type& type) {
    switch (type.kind) {
        case Type::Kind::structure: {
            std::size_t size = 0;
            for (const Type::Field& field : type.fields) size += min_cdr_size(*field.type);
            return std::max(size, std::size_t{1});
        }
        case Type::Kind::array: return type.length * min_cdr_size(*type.element);
        case Type::Kind::boolean:
        case Type::Kind::any: return 1;
        case Type::Kind::text: return sizeof(std::uint32_t) + 1;
        default: return type.is_number() ? type.size : sizeof(std::uint32_t);
    }
}

// Reverses the bytes of each of these numbers.
void swap_bytes(void* first, std::size_t each, std::size_t count) {
    auto* at = static_cast<std::uint8_t*>(first);
    for (std::size_t i = 0; i < count; ++i, at += each) std::reverse(at, at + each);
}

}  // namespace

CdrTime to_cdr_time(double seconds) {
    constexpr double most = std::numeric_limits<std::uint32_t>::max();
    if (!(seconds > 0)) return {};
    if (seconds > most) return {.sec = std::numeric_limits<std::uint32_t>::max(), .nsec = nanoseconds - 1};
    const double whole = std::floor(seconds);
    CdrTime time{.sec = static_cast<std::uint32_t>(whole),
                 .nsec = static_cast<std::uint32_t>(std::lround((seconds - whole) * nanoseconds))};
    if (time.nsec == nanoseconds) time = {.sec = time.sec + 1, .nsec = 0};
    return time;
}

double to_seconds(const CdrTime& time) {
    // Up to 104 days (less the 4 s that `nsec` may hold), a double holds all nanoseconds exactly, so there is only one
    // rounding. Later times are so coarse that rounding the fraction first makes no difference.
    constexpr std::uint32_t exact = (std::uint64_t{1} << 53) / nanoseconds - 5;
    if (time.sec < exact) {
        return static_cast<double>(std::uint64_t{time.sec} * nanoseconds + time.nsec) / nanoseconds;
    }
    return time.sec + static_cast<double>(time.nsec) / nanoseconds;
}

void write_cdr_message(Octets& out, const ValueView& data, double tm, const CdrFormat& format) {
    write_cdr(out, format, to_cdr_time(tm), data);
}

Expected<void> read_cdr_message(std::span<const std::uint8_t> bytes, const ValuePlace& data, double& tm,
                                const CdrFormat& format) {
    CdrTime time;
    Expected<void> read = read_cdr(bytes, format, time, data);
    if (read) tm = to_seconds(time);
    return read;
}

namespace detail {

CdrWriter::CdrWriter(Octets& out, const CdrFormat& format) : out_(out), swap_(format.order != std::endian::native) {
    if (!format.header) return;
    const std::uint8_t order = format.order == std::endian::little ? 1 : 0;
    out_.insert(out_.end(), {0, order, 0, 0});
    origin_ = out_.size();
}

void CdrWriter::write(const ValueView& value) {
    switch (value.type->kind) {
        case Type::Kind::structure:
            for (const Type::Field& field : value.type->fields) write(value.field(field));
            return;
        case Type::Kind::sequence: write_length(value.count()); return write_elements(value);
        case Type::Kind::array: return write_elements(value);
        case Type::Kind::text: {
            const auto& text = value.as<std::string>();
            write_length(text.size() + 1);
            return write_bytes(text.c_str(), text.size() + 1);
        }
        case Type::Kind::octets: {
            const auto& octets = value.as<Octets>();
            write_length(octets.size());
            return write_bytes(octets.data(), octets.size());
        }
        case Type::Kind::boolean: out_.push_back(value.as<bool>() ? 1 : 0); return;
        case Type::Kind::enumeration: return write_length(value.choice());
        case Type::Kind::any: return write_any(value.as<Value>());
        case Type::Kind::nothing: return;
        default: assert(value.type->is_number()); return write_numbers(value.type->size, value.at, 1);
    }
}

void CdrWriter::write_any(const Value& value) {
    const auto types = plain_types();
    const auto type =
        std::find_if(types.begin(), types.end(), [&](const PlainType& each) { return each.type == &value.type(); });
    assert(type != types.end());
    out_.push_back(static_cast<std::uint8_t>(type - types.begin()));
    write(value);
}

void CdrWriter::write_elements(const ValueView& value) {
    const std::size_t count = value.count();
    if (count == 0) return;
    if (value.type->element->is_number()) {
        return write_numbers(value.type->element->size, value.first(), count);
    }
    for_each_element(value, [&](const ValueView& element) {
        write(element);
        return true;
    });
}

void CdrWriter::write_length(std::size_t length) {
    assert(length <= std::numeric_limits<std::uint32_t>::max());
    const auto count = static_cast<std::uint32_t>(length);
    write_numbers(sizeof count, &count, 1);
}

void CdrWriter::write_bytes(const void* first, std::size_t size) {
    const auto* bytes = static_cast<const std::uint8_t*>(first);
    out_.insert(out_.end(), bytes, bytes + size);
}

void CdrWriter::write_numbers(std::size_t each, const void* first, std::size_t count) {
    const std::size_t padding = (origin_ - out_.size()) & (each - 1);
    out_.resize(out_.size() + padding);
    write_bytes(first, each * count);
    if (swap_) swap_bytes(out_.data() + out_.size() - each * count, each, count);
}

CdrReader::CdrReader(std::span<const std::uint8_t> bytes, const CdrFormat& format)
    : bytes_(bytes), swap_(format.order != std::endian::native) {
    if (bytes.size() > most_cdr_bytes) {
        fail(0, fmt::format("expected at most {} bytes, got {}", most_cdr_bytes, bytes.size()));
    }
    if (!format.header) return;
    const std::uint8_t* header = take(1, header_size);
    if (header == nullptr) return;
    if (header[0] != 0 || header[1] > 1) {
        fail(0,
             fmt::format("expected the header of plain CDR (00 00 or 00 01), got {:02x} {:02x}", header[0], header[1]));
        return;
    }
    swap_ = (header[1] == 1) != (std::endian::native == std::endian::little);
    origin_ = at_;
    padding_ = 3;
}

Expected<void> CdrReader::finish() {
    const std::size_t left = bytes_.size() - at_;
    field_ = {};
    if (left > padding_) fail(at_, fmt::format("expected the end, got {} more bytes", left));
    if (error_) return Unexpected(*error_);
    return {};
}

const std::uint8_t* CdrReader::take(std::size_t alignment, std::size_t size) {
    if (error_) return nullptr;
    const std::size_t begin = at_ + ((origin_ - at_) & (alignment - 1));
    if (begin > bytes_.size() || bytes_.size() - begin < size) {
        fail(std::min(begin, bytes_.size()),
             fmt::format("expected {} bytes, {} are left", size, bytes_.size() - std::min(begin, bytes_.size())));
        return nullptr;
    }
    at_ = begin + size;
    return bytes_.data() + begin;
}

void CdrReader::read(const ValuePlace& value) {
    switch (value.type->kind) {
        case Type::Kind::structure:
            for (const Type::Field& field : value.type->fields) {
                if (error_) return;
                field_ = field.name;
                read(value.field(field));
            }
            field_ = {};
            return;
        case Type::Kind::array: return read_elements(value);
        case Type::Kind::sequence: return read_sequence(value);
        case Type::Kind::text: return read_text(value.as<std::string>());
        case Type::Kind::octets: return read_octets(value.as<Octets>());
        case Type::Kind::boolean: value.as<bool>() = read_truth(); return;
        case Type::Kind::enumeration: return read_choice(value);
        case Type::Kind::any: return read_any(value.as<Value>());
        case Type::Kind::nothing: return;
        default: assert(value.type->is_number()); return read_numbers(value.type->size, value.at, 1);
    }
}

void CdrReader::read_any(Value& value) {
    const std::uint8_t* place = take(1, 1);
    if (place == nullptr) return;
    const auto types = plain_types();
    if (*place >= types.size())
        return fail(at_ - 1,
                    fmt::format("expected the number of a type, from 0 to {}, got {}", types.size() - 1, *place));
    value = Value(*types[*place].type);
    read(value);
}

void CdrReader::read_elements(const ValuePlace& value) {
    const std::size_t count = value.count();
    if (value.type->element->is_number()) {
        return read_numbers(value.type->element->size, value.first(), count);
    }
    for_each_element(value, [&](const ValuePlace& element) {
        read(element);
        return !error_;
    });
}

void CdrReader::read_sequence(const ValuePlace& value) {
    const std::size_t count = read_length(min_cdr_size(*value.type->element));
    value.resize(count);
    if (count > 0) read_elements(value);
}

void CdrReader::read_numbers(std::size_t each, void* first, std::size_t count) {
    const std::uint8_t* bytes = take(each, each * count);
    if (bytes == nullptr) return;
    std::memcpy(first, bytes, each * count);
    if (swap_) swap_bytes(first, each, count);
}

void CdrReader::read_octets(Octets& octets) {
    const std::size_t count = read_length(1);
    const std::uint8_t* bytes = take(1, count);
    octets.assign(bytes, bytes != nullptr ? bytes + count : bytes);
}

std::size_t CdrReader::read_length(std::size_t element_size) {
    std::uint32_t count = 0;
    read_numbers(sizeof count, &count, 1);
    const std::size_t left = bytes_.size() - at_;
    if (count <= left / element_size) return count;
    fail(at_ - sizeof count,
         fmt::format("expected {} elements of at least {} bytes, {} bytes are left", count, element_size, left));
    return 0;
}

bool CdrReader::read_truth() {
    const std::uint8_t* byte = take(1, 1);
    if (byte == nullptr || *byte <= 1) return byte != nullptr && *byte == 1;
    fail(at_ - 1, fmt::format("expected a boolean (0 or 1), got {}", *byte));
    return false;
}

void CdrReader::read_choice(const ValuePlace& value) {
    std::uint32_t choice = 0;
    read_numbers(sizeof choice, &choice, 1);
    const std::size_t count = value.type->choices.size();
    if (choice < count) return value.set_choice(choice);
    fail(at_ - sizeof choice, fmt::format("expected a choice from 0 to {}, got {}", count - 1, choice));
}

void CdrReader::read_text(std::string& text) {
    const std::size_t length = read_length(1);
    const std::uint8_t* bytes = take(1, length);
    if (bytes == nullptr) return;
    if (length == 0)
        return fail(at_ - sizeof(std::uint32_t),
                    "expected a string length of 1 or more (it includes the final 0), got 0");
    if (bytes[length - 1] != 0)
        return fail(at_ - 1, fmt::format("expected the final 0 of a string, got {}", bytes[length - 1]));
    text.assign(reinterpret_cast<const char*>(bytes), length - 1);
}

void CdrReader::fail(std::size_t at, const std::string& what) {
    if (error_) return;
    const std::string field = field_.empty() ? "" : fmt::format(", field '{}'", field_);
    error_ = Error{.message = fmt::format("byte {}{}: {}", at, field, what)};
}

}  // namespace detail
}  // namespace nezumi
