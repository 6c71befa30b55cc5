// Messages from a browser's page: untrusted JSON objects.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "bindings/console/peers.hpp"
#include "bindings/web/changes.hpp"
#include "engine/base/error.hpp"
#include "engine/live/script_host.hpp"
#include "engine/ports/messages.hpp"
#include "engine/system/act.hpp"

namespace nezumi::web {

struct ActMessage {
    Act act;
    std::string shown;  ///< for the log: its name and fields, shortened
};
struct TimeMessage {
    enum class What { pause, resume, step, speed, restart, quit };
    What what = What::pause;
    std::optional<double> value{};  ///< of step and speed; infinity is the text "max"
};
/// Holds a port while the message is repeated.
struct DriveMessage {
    std::string port;
    std::optional<Value> value{};  ///< none: releases the port
    bool take = false;
};
/// A request of the console's protocol.
struct ConsoleMessage {
    std::string line;   ///< with its line end
    std::string shown;  ///< the code to evaluate; "" if there is none
};

/// Requests the explanation of a behaviour's next execution.
struct ExplainMessage {
    std::string component;
};
/// A request to a component of another program.
struct PeerMessage {
    PeerRequest request;
    std::string shown;  ///< for the log
};
/// Requests the picture of the floor.
struct FloorMessage {};

/// Requests the list of running systems.
struct SystemsMessage {};

struct BrowserMessage {
    std::int64_t id = 0;  ///< chosen by the page; the answer has the same id
    std::variant<Watch, ActMessage, TimeMessage, DriveMessage, ConsoleMessage, FloorMessage, ExplainMessage,
                 SystemsMessage, PeerMessage>
        body{};
};

/// The `id` of a wrong message, if it could be read, and the error.
struct Refusal {
    std::int64_t id = 0;
    std::string text;
};

/// The largest number of ports that a browser may watch, and of pictures.
inline constexpr std::size_t most_watched = 256;

/// Reads one message. `parts` reads the entry of an act.
tl::expected<BrowserMessage, Refusal> read_message(std::string_view text, const PartReader& parts);

}  // namespace nezumi::web
