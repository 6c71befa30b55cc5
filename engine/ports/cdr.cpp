// CDR's header, lengths, texts and errors; messages whose type is only known at run time.
#include "engine/ports/cdr.hpp"

#include <fmt/format.h>

#include <cmath>

namespace nezumi {
namespace {

constexpr std::size_t header_size = 4;
constexpr std::uint32_t nanoseconds = 1'000'000'000;

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
    // Rounds once while a double holds all nanoseconds: 104 days, less the 4 s that `nsec` may hold. Later a double is
    // so coarse that rounding the fraction first makes no difference.
    constexpr std::uint32_t exact = (std::uint64_t{1} << 53) / nanoseconds - 5;
    if (time.sec < exact) {
        return static_cast<double>(std::uint64_t{time.sec} * nanoseconds + time.nsec) / nanoseconds;
    }
    return time.sec + static_cast<double>(time.nsec) / nanoseconds;
}

void write_cdr_message(Octets& out, const AnyPayload& data, double tm, const CdrFormat& format) {
    std::visit([&](const auto& payload) { write_cdr_message(out, payload, tm, format); }, data);
}

Expected<void> read_cdr_message(std::span<const std::uint8_t> bytes, AnyPayload& data, double& tm,
                                const CdrFormat& format) {
    return std::visit([&](auto& payload) { return read_cdr_message(bytes, payload, tm, format); }, data);
}

namespace detail {

CdrWriter::CdrWriter(Octets& out, const CdrFormat& format) : out_(out), swap_(format.order != std::endian::native) {
    if (!format.header) return;
    const std::uint8_t order = format.order == std::endian::little ? 1 : 0;
    out_.insert(out_.end(), {0, order, 0, 0});
    origin_ = out_.size();
}

void CdrWriter::append(std::size_t alignment, const void* data, std::size_t size) {
    constexpr std::array<std::uint8_t, 8> zeros{};
    const std::size_t padding = (alignment - (out_.size() - origin_) % alignment) % alignment;
    out_.insert(out_.end(), zeros.begin(), zeros.begin() + padding);
    const auto* bytes = static_cast<const std::uint8_t*>(data);
    out_.insert(out_.end(), bytes, bytes + size);
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
    const std::size_t begin = at_ + (alignment - (at_ - origin_) % alignment) % alignment;
    if (begin > bytes_.size() || bytes_.size() - begin < size) {
        fail(std::min(begin, bytes_.size()),
             fmt::format("expected {} bytes, {} are left", size, bytes_.size() - std::min(begin, bytes_.size())));
        return nullptr;
    }
    at_ = begin + size;
    return bytes_.data() + begin;
}

std::size_t CdrReader::read_length(std::size_t element_size) {
    std::uint32_t count = 0;
    read(count);
    const std::size_t left = bytes_.size() - at_;
    if (count <= left / element_size) return count;
    fail(at_ - sizeof count,
         fmt::format("expected {} elements of at least {} bytes, {} bytes are left", count, element_size, left));
    return 0;
}

bool CdrReader::read_truth() {
    const std::uint8_t* byte = take(1, 1);
    if (byte == nullptr || *byte <= 1) return byte != nullptr && *byte == 1;
    fail(at_ - 1, fmt::format("expected a truth value (0 or 1), got {}", *byte));
    return false;
}

void CdrReader::read_text(std::string& text) {
    const std::size_t length = read_length(1);
    const std::uint8_t* bytes = take(1, length);
    if (bytes == nullptr) return;
    if (length == 0)
        return fail(at_ - sizeof(std::uint32_t),
                    "expected a text's length of 1 or more (it counts the final 0), got 0");
    if (bytes[length - 1] != 0)
        return fail(at_ - 1, fmt::format("expected a text's final 0, got {}", bytes[length - 1]));
    text.assign(reinterpret_cast<const char*>(bytes), length - 1);
}

void CdrReader::fail(std::size_t at, const std::string& what) {
    if (error_) return;
    const std::string field = field_.empty() ? "" : fmt::format(", field '{}'", field_);
    error_ = Error{.message = fmt::format("byte {}{}: {}", at, field, what)};
}

}  // namespace detail
}  // namespace nezumi
