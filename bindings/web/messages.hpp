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
    std::string shown;  ///< text for the log: name and fields of the act, shortened
};
struct TimeMessage {
    enum class What { pause, resume, step, speed, restart, quit };
    What what = What::pause;
    std::optional<double> value{};  ///< the number of `step` or `speed`; infinity for the text "max"
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

/// A request of the page's editor.
struct EditMessage {
    enum class What {
        list,      ///< the files of the project
        read,      ///< the text of `file`
        check,     ///< checks `text` as the new text of `file`
        save,      ///< writes `text`; `mark` is the mark of the text that the page has read, "" for a new file
        versions,  ///< the kept versions of `file`
        version,   ///< the text of version `number`
        words,     ///< the annotations of all global names and types
    };
    What what = What::list;
    std::string file{};
    std::string text{};
    std::string mark{};
    int number = 0;
};

/// A request about the project's scenarios.
struct TestMessage {
    enum class What {
        list,        ///< the names and locations of the scenarios
        run,         ///< runs the scenarios of `file`, all scenarios, or only the scenario with this `name`
        stop,        ///< ends the present run
        open,        ///< opens the failed run that is kept in the folder `file`, in a page of its own
        watch,       ///< runs the scenario `name` of `file` in a page of its own, in real time
        recordings,  ///< the names of the project's recordings and journals
        judge,       ///< judges the behaviour in the file `name` by the recording `file`
    };
    What what = What::list;
    std::string file{};
    std::string name{};
};

/// Requests the remembered acts, errors and poses of a branch, for the time line.
struct RememberedMessage {
    std::string branch;
    bool rows = false;   ///< also the poses of robots and things
    std::string port{};  ///< also the recent numbers of this port, for a plot; "" for none
};

/// Requests the values of ports and members at a time of the present branch.
struct ThenMessage {
    double at = 0;  ///< [s]
    std::vector<std::string> names;
};

/// Requests the numbers of a port since the last start, for a plot. Numbers that are not remembered are computed again.
struct EarlierMessage {
    std::string port;
};

/// Requests the list of running systems.
struct SystemsMessage {};

struct BrowserMessage {
    std::int64_t id = 0;  ///< chosen by the page; the answer has the same id
    std::variant<Watch, ActMessage, TimeMessage, DriveMessage, ConsoleMessage, FloorMessage, ExplainMessage,
                 RememberedMessage, ThenMessage, EarlierMessage, SystemsMessage, PeerMessage, EditMessage, TestMessage>
        body{};
};

/// An error of a message, with the message's `id` if that could be read.
struct Refusal {
    std::int64_t id = 0;
    std::string text;
};

/// The largest number of ports that a browser may watch, and of pictures.
inline constexpr std::size_t most_watched = 256;

/// Reads one message. `parts` reads the entry of an act.
tl::expected<BrowserMessage, Refusal> read_message(std::string_view text, const PartReader& parts);

}  // namespace nezumi::web
