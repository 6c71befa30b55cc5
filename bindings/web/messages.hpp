// What a browser's page says: JSON objects, read with suspicion.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "bindings/web/changes.hpp"
#include "engine/base/error.hpp"
#include "engine/live/script_host.hpp"
#include "engine/ports/messages.hpp"
#include "engine/system/act.hpp"

namespace nezumi::web {

struct ActMessage {
    Act act;
    std::string shown;  ///< for the log: its name and fields, cut
};
struct TimeMessage {
    enum class What { pause, resume, step, speed, restart, quit };
    What what = What::pause;
    std::optional<double> value{};  ///< of step and speed; infinity as text "max"
};
/// Holds a port for as long as it comes again.
struct DriveMessage {
    std::string port;
    std::optional<Value> value{};  ///< none: lets go
    bool take = false;
};
/// A request of the console's protocol.
struct ConsoleMessage {
    std::string line;   ///< with its end
    std::string shown;  ///< what it evaluates; "" when it evaluates nothing
};

/// Wants the next execution of a behaviour explained.
struct ExplainMessage {
    std::string component;
};
/// Wants the picture on the floor.
struct FloorMessage {};

/// Wants to know which systems run.
struct SystemsMessage {};

struct BrowserMessage {
    std::int64_t id = 0;  ///< of the page's choice; an answer carries it
    std::variant<Watch, ActMessage, TimeMessage, DriveMessage, ConsoleMessage, FloorMessage, ExplainMessage,
                 SystemsMessage>
        body{};
};

/// What came with `id`, as far as that could be read, and what is wrong.
struct Refusal {
    std::int64_t id = 0;
    std::string text;
};

/// Ports that a browser may watch, and pictures.
inline constexpr std::size_t most_watched = 256;

/// Reads one message. `parts` reads an act's entry.
tl::expected<BrowserMessage, Refusal> read_message(std::string_view text, const PartReader& parts);

}  // namespace nezumi::web
