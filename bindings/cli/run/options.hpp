// The options of `nezumi run`: as typed, and as checked values.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "bindings/cli/run/hardware.hpp"
#include "bindings/cli/shell/command_line.hpp"
#include "engine/base/error.hpp"
#include "engine/live/script_host.hpp"

namespace nezumi::cli {

/// The options as they were typed: "" for what was not given.
struct RunWords {
    std::string file;
    std::string speed, duration, seed, threads, picture, record, ports, sounds, journal, replay;
    std::string dev_root, sys_root, device_log, played_log;
    std::string params;
    std::string every;
    std::string history;
    std::string profile;
    std::string port, listen;
    std::vector<std::string> set;
    FlagText hw;
    bool headless = false;
    bool batch = false;
    bool trace_hash = false;
    bool keep_going = false;
    bool real_time = false;
    bool twin = false;
    bool no_web = false;
    bool open = false;
    bool page_on_input = false;
    bool stopped = false;
    bool opens_replay = false;  ///< true for `nezumi open`
};

/// The options of `nezumi run`. Parsing stores the typed values in `words`, which must exist until then.
std::vector<Option> run_options(RunWords& words);
/// The options of `nezumi open`; its argument RUN is stored in `replay`.
std::vector<Option> open_options(RunWords& words);

/// Where the page for browsers is served.
struct Web {
    int port = 8765;           ///< or the next free one
    bool open = false;         ///< the page is shown in the desktop's browser, where there is one
    bool on_input = false;     ///< standard input is a socket of `nezumi class`, to which the browsers are connected
    std::string only_shows{};  ///< why browsers may change only the speed; "": they may change everything
    std::string listen{};  ///< IPv4 address at which other computers reach the page, by TLS; "": only this computer can
};

struct RunOptions {
    std::string file;
    bool headless = false;
    bool stopped = false;  ///< begins with an emergency stop
    bool batch = false;    ///< commands come from standard input; headless as well
    double speed = 1;      ///< a factor of real time; `as_fast_as_possible` for "max"
    double duration = std::numeric_limits<double>::infinity();  ///< [s] of simulated time
    std::optional<std::uint64_t> seed;
    bool keep_going = false;        ///< a behaviour that can't be loaded is left out
    std::optional<double> history;  ///< [min] of values that are remembered; none: `Series::usual_samples`
    int threads = 1;
    bool trace_hash = false;
    bool real_time = false;            ///< real-time priority for the ticks; requires a finite `speed`
    std::string picture;               ///< "" for none; ends in .png or .svg
    std::string profile;               ///< "" for none; ends in .svg or .json
    std::string record;                ///< "" for none
    std::vector<std::string> ports;    ///< "name.port"; empty: every out-port
    std::int64_t every = 1;            ///< every N-th tick is recorded
    std::string journal;               ///< "" for none
    std::string replay;                ///< "" for none
    std::string only_repeats;          ///< why the run, a replay, may not be changed; "": it may be changed
    bool opens_replay = false;         ///< the replay comes first, as fast as possible; then the run is paused
    std::string sounds;                ///< folder for the speech and tones of robots; "" for none
    StartValues values;                ///< replace parameters of the system file
    std::optional<Web> web;            ///< none: no page is served
    std::optional<Hardware> hardware;  ///< none: everything is simulated
};

/// Where the page is served; none: nowhere.
Expected<std::optional<Web>> read_web(const RunWords& words, bool headless);

/// Converts the typed options to values. The error is that of the first wrong option.
Expected<RunOptions> read_run_options(const RunWords& words);

}  // namespace nezumi::cli
