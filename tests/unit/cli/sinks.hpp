// The outputs of a run, and what happens when one of them accepts no data: a table of docs/reliability.md.
#pragma once

#include <array>
#include <string_view>

namespace nezumi {

struct Sink {
    std::string_view name;
    std::string_view takes_nothing;  ///< how
    bool ticks_go_on;
    bool ends_at_once;  ///< after SIGTERM; or else within 2 s
    int status;         ///< then
    std::string_view lost;
};

inline constexpr std::array sinks{
    Sink{"standard error: the log", "a pipe that is not read", true, false, 1,
         "lines beyond 4 MB (their number is written instead); lines that wait at the end"},
    Sink{"standard error: the log of a run that does not follow a clock", "a pipe that is not read", false, false, 1,
         "nothing during the run, because time waits; lines that wait at the end"},
    Sink{"standard error: log and status line", "a terminal after Ctrl-S", true, false, 1,
         "lines beyond 4 MB (their number is written instead); lines that wait at the end"},
    Sink{"the prompt's terminal", "Ctrl-S", true, false, 1,
         "lines beyond 1 MB (their number is written instead); lines that wait at the end"},
    Sink{"standard output of `--batch`", "a pipe that is not read", false, false, 1,
         "nothing during the run, because time waits; lines that wait at the end"},
    Sink{"standard output: the trace hash", "a pipe that is full and not read", true, false, 1, "the hash"},
    Sink{"`--record`", "a FIFO that is full and not read", true, false, 2,
         "values that wait at the end, with a message; if more than 64 MB wait, the run ends with a message"},
    Sink{"`--journal`", "a FIFO that is full and not read", true, false, 2,
         "values that wait at the end, with a message; if more than 64 MB wait, the run ends with a message"},
    Sink{"`--device-log`", "a FIFO that is full and not read", true, false, 0,
         "values that wait at the end, with a message; if more than 64 MB wait, the run continues without the log, "
         "with a message"},
    Sink{"`--picture`", "a FIFO that is full and not read", true, false, 2, "the picture"},
    Sink{"`save`, `picture` and `graph` of a console", "a FIFO", true, true, 0,
         "nothing: refused at once, like everything that is not a file"},
    Sink{"a console of `nezumi attach`", "stopped (SIGSTOP)", true, true, 0,
         "lines beyond 1 MB (their number is written instead)"},
    Sink{"a browser", "its connection is not read", true, true, 0,
         "lines beyond 1 MB (their number is written instead); beyond 4 MB of answers the connection is closed"},
};

constexpr const Sink& sink(std::string_view name) {
    for (const Sink& each : sinks) {
        if (each.name == name) return each;
    }
    throw "no such row";
}

}  // namespace nezumi
