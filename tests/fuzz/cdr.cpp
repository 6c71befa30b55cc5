// Reads any bytes as a CDR stream of every message type: what is taken is written again as it was, or an error says
// where.
#include <cstdint>

#include "engine/ports/payload.hpp"
#include "engine/values/cdr.hpp"
#include "tests/fuzz/require.hpp"

using namespace nezumi;

namespace {

template <Payload T>
void check(std::span<const std::uint8_t> stream, const CdrFormat& format) {
    CdrTime time;
    T data{};
    const auto read = read_cdr(stream, format, time, data);
    if (!read) {
        require_line(read.error().message);
        return;
    }
    require(heap_bytes(data) <= 16 * stream.size());
    const CdrFormat same{.order = format.header && stream[1] == 0 ? std::endian::big : format.order,
                         .header = format.header};
    Octets written;
    write_cdr(written, same, time, data);
    const std::size_t padding = stream.size() - written.size();
    require(written.size() <= stream.size() && padding <= (format.header ? 3 : 0));

    // Read again, over what was there: the same bytes, without looking at numbers that aren't equal to themselves.
    require(read_cdr(written, same, time, data).has_value());
    Octets again;
    write_cdr(again, same, time, data);
    require(again == written);
    require(to_seconds(time) >= 0 && to_seconds(time) < 4.3e9);
}

}  // namespace

// The first byte: the type and the format; the others: the stream.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const CdrFormat format{.order = (data[0] & 0x40) != 0 ? std::endian::big : std::endian::little,
                           .header = (data[0] & 0x80) != 0};
    const std::span stream(data + 1, size - 1);
    with_payload_type(compiled_message_types()[(data[0] & 0x3f) % compiled_message_count], [&]<class T>() {
        if constexpr (Payload<T>) check<T>(stream, format);
    });
    return 0;
}
