// Feeds the reader of browsers' messages whatever a WebSocket could bring: it takes a message or says why not.
#include <cstdint>
#include <string_view>

#include "bindings/lua/reload/lua_host.hpp"
#include "bindings/web/messages.hpp"
#include "tests/fuzz/require.hpp"

using namespace nezumi;

namespace {

void check(const web::BrowserMessage& message) {
    if (const auto* watch = std::get_if<web::Watch>(&message.body))
        require(watch->ports.size() <= web::most_watched && watch->pictures.size() <= web::most_watched);
    if (const auto* act = std::get_if<web::ActMessage>(&message.body)) require(act->shown.size() < 200);
    if (const auto* console = std::get_if<web::ConsoleMessage>(&message.body))
        require(console->line.ends_with('\n') && console->line.find('\n') == console->line.size() - 1);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const PartReader parts{Project::of("behaviors/systems/fuzz.lua"), &lua_scripts()};
    const auto message = web::read_message({reinterpret_cast<const char*>(data), size}, parts);
    if (message) {
        check(*message);
    } else {
        require(!message.error().text.empty() && message.error().text.size() < 4000);
    }
    return 0;
}
