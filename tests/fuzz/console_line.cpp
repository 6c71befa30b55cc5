// Feeds the console's reader whatever a socket could bring: it takes a line or says why not, and keeps no more than
// one.
#include <cstdint>
#include <string>
#include <string_view>

#include "bindings/console/client.hpp"
#include "bindings/console/protocol.hpp"
#include "bindings/terminal/tty_input.hpp"
#include "engine/base/visible.hpp"
#include "tests/fuzz/require.hpp"

using namespace nezumi;

namespace {

constexpr std::size_t limit = 200;

void check_line(const std::string& line) {
    require(line.size() <= limit && line.find('\n') == std::string::npos);
    if (const auto request = read_request(line)) {
        const auto again = read_request(to_line(*request));
        require(again.has_value() && *again == *request);
    } else {
        require_line(request.error().message);
    }
    if (const auto event = read_event(line)) {
        const auto again = read_event(to_line(*event));
        require(again.has_value() && *again == *event);
    }
}

}  // namespace

// The first byte says into how large pieces the rest is cut.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::size_t piece = data[0] + std::size_t{1};
    const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
    LineReader reader(limit);
    for (std::size_t at = 0; at < text.size(); at += piece) {
        reader.feed(text.substr(at, piece));
        while (const auto line = reader.next()) {
            if (*line) check_line(**line);
        }
    }
    require(visible(text).find('\x1b') == std::string::npos);
    require(to_utf8(to_wide(text)) == to_utf8(to_wide(to_utf8(to_wide(text)))));
    for (std::string_view typed = text; !typed.empty();) {
        const TypedKey key = next_key(typed, true);
        require(key.size > 0 && key.size <= typed.size());
        typed.remove_prefix(key.size);
    }
    return 0;
}
