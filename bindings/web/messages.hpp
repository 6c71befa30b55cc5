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

/// A request of the page's editor.
struct EditMessage {
    enum class What {
        list,      ///< the files of the project
        read,      ///< the text of `file`
        check,     ///< what is wrong in `text`, which `file` would have
        save,      ///< writes `text`; `mark` is that of the text that was read, "" for a new file
        versions,  ///< the kept versions of `file`
        version,   ///< the text of version `number`
        words,     ///< the annotations of all words and types
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
        list,        ///< their names and places
        run,         ///< runs those of `file`, or all, or only the one called `name`
        stop,        ///< ends the present run
        open,        ///< opens the failed run that is kept in the folder `file`, in a page of its own
        watch,       ///< runs the one called `name` of `file` in a page of its own, at the pace of the clock
        recordings,  ///< the names of the project's recordings and journals
        judge,       ///< judges the behaviour in the file `name` by the recording `file`
    };
    What what = What::list;
    std::string file{};
    std::string name{};
};

/// Requests what is remembered of a branch, for the time line.
struct RememberedMessage {
    std::string branch;
    bool rows = false;   ///< also where robots were
    std::string port{};  ///< also the recent numbers of this port of the present, for a plot; may be empty
};

/// Requests what ports and members had at a time of the present branch.
struct ThenMessage {
    double at = 0;  ///< [s]
    std::vector<std::string> names;
};

/// Requests the numbers of a port since the last start, for a plot; what is not remembered is computed again.
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
