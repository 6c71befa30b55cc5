// Options are read as strings first, so that each wrong one gives an error of one plain sentence.
#include "bindings/cli/run/options.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <string_view>

#include "bindings/cli/files/output_files.hpp"
#include "engine/base/number_in.hpp"
#include "engine/live/run_loop.hpp"

namespace nezumi::cli {
namespace {

constexpr double longest = 1e9;  // [s], some thirty years
constexpr int most_threads = 256;
constexpr double longest_history = 10'000;  // [min] a week

Unexpected wrong(std::string_view option, std::string_view expected, std::string_view got) {
    return failure(fmt::format("{}: expected {}, got '{}'", option, expected, shown(got)));
}

// Splits "a, b" into its parts. An error if a part is empty.
Expected<std::vector<std::string>> split(std::string_view option, std::string_view expected, const std::string& given) {
    std::vector<std::string> parts;
    std::string_view words = given;
    while (true) {
        const auto comma = words.find(',');
        std::string_view part = words.substr(0, comma);
        while (!part.empty() && part.front() == ' ') part.remove_prefix(1);
        while (!part.empty() && part.back() == ' ') part.remove_suffix(1);
        if (part.empty()) return wrong(option, expected, given);
        parts.emplace_back(part);
        if (comma == std::string_view::npos) return parts;
        words.remove_prefix(comma + 1);
    }
}

// Checks the options that real robots need, and those that are impossible with them.
Expected<std::optional<Hardware>> read_hardware(const RunWords& words) {
    if (words.hw.text.empty()) {
        for (const auto& [option, given] : {std::pair{"--dev-root", words.dev_root},
                                            {"--sys-root", words.sys_root},
                                            {"--device-log", words.device_log},
                                            {"--device-log-play", words.played_log}}) {
            if (!given.empty()) return failure(fmt::format("{} is for real robots: give --hw as well", option));
        }
        if (words.twin) return failure("--twin is for real robots: give --hw as well");
        return std::nullopt;
    }
    for (const auto& [option, given] :
         {std::pair{"--speed", !words.speed.empty()}, {"--batch", words.batch}, {"--replay", !words.replay.empty()}}) {
        if (given) return failure(fmt::format("--hw: real robots run only in real time: leave out {}", option));
    }
    for (const auto& [option, given] : {std::pair{"--dev-root", words.dev_root},
                                        {"--sys-root", words.sys_root},
                                        {"--device-log", words.device_log}}) {
        if (!words.played_log.empty() && !given.empty())
            return failure(fmt::format("--device-log-play: no device is used: leave out {}", option));
    }
    if (words.twin && !words.threads.empty())
        return failure("--twin: the real robot and its twin share a thread: leave out --threads");
    Hardware hardware{.twins = words.twin};
    if (words.hw.text != "true") {
        auto robots = split("--hw", "names of robots as in --hw=mouse", words.hw.text);
        if (!robots) return Unexpected(robots.error());
        hardware.robots = std::move(*robots);
    }
    if (!words.dev_root.empty()) hardware.dev_root = words.dev_root;
    if (!words.sys_root.empty()) hardware.sys_root = words.sys_root;
    hardware.device_log = words.device_log;
    hardware.played_log = words.played_log;
    return hardware;
}

}  // namespace

Expected<std::optional<Web>> read_web(const RunWords& words, bool headless) {
    for (const auto& [option, given] :
         {std::pair{"--port", !words.port.empty()}, {"--listen", !words.listen.empty()}, {"--open", words.open}}) {
        if (!given) continue;
        if (headless) return failure(fmt::format("{}: a headless run has no page: leave out this option", option));
        if (words.no_web) return failure(fmt::format("{}: --no-web serves no page: leave out one of them", option));
    }
    if (headless || words.no_web) return std::nullopt;
    Web web{.open = words.open, .on_input = words.page_on_input, .listen = words.listen};
    in_addr address{};
    if (!words.listen.empty() && (inet_pton(AF_INET, words.listen.c_str(), &address) != 1 || address.s_addr == 0))
        return wrong("--listen", "the IPv4 address at which others reach this computer, as in 192.168.1.20",
                     words.listen);
    if (!words.port.empty()) {
        const auto port = number_in<int>(words.port);
        if (!port || *port < 1 || *port > 65535) return wrong("--port", "a whole number from 1 to 65535", words.port);
        web.port = *port;
    }
    return web;
}

std::vector<Option> run_options(RunWords& words) {
    return {
        {"[FILE]",
         &words.file,
         "the system file, or its name: corridor is behaviors/systems/corridor.lua; --replay needs none. A recording "
         "RUN.mcap or a journal RUN.journal is repeated as by --replay",
         "",
         {},
         FileUse::source},
        {"--hw", &words.hw,
         "drive the real robots; --hw=NAME,...: only these; the others are simulated, and real and simulated robots do "
         "not see each other"},
        {"--twin", &words.twin,
         "with --hw: also simulate each real robot with the same commands; NAME_twin.error is their difference"},
        {"--headless", &words.headless,
         "for automation: no terminal, no reload when a file is saved. A call into a script that takes more than 2 s "
         "ends the run"},
        {"--batch", &words.batch,
         "console commands come from standard input; time moves only by their step and run, as fast as possible "
         "unless --speed is given. In other respects like --headless"},
        {"--speed", &words.speed, "a factor of real time (default 1), or max: as fast as possible", "N|max"},
        {"--port", &words.port, "serve the page for browsers on this port, or the next free one (default 8765)", "N"},
        {"--no-web", &words.no_web, "serve no page for browsers"},
        {"--open", &words.open,
         "show the page in the desktop's browser; without a desktop its address is printed alone"},
        {"--listen", &words.listen,
         "serve the page to other computers, too, at this address of this computer, by TLS with its own certificate",
         "ADDRESS"},
        {"--page-on-input", &words.page_on_input,
         "serve the page over the socket that is standard input: for `nezumi class`, which has the browsers"},
        {"--stopped", &words.stopped, "begin with an emergency stop: robots move when it is re-armed"},
        {"--realtime", &words.real_time, "real-time priority for the ticks: SCHED_FIFO and locked memory"},
        {"--duration", &words.duration, "end at this simulated time [s] (default: at Ctrl-C)", "S"},
        {"--seed", &words.seed, "the seed of all random numbers, instead of the file's seed(n) (default 124)", "N"},
        {"--set", &words.set,
         "set a parameter instead of the system file, also after a restart; may be repeated: mouse.speed=0.3, "
         "\"wander_*.speed=0.3\"; n=10 sets the file's argument(\"n\", 5)",
         "NAME.PARAMETER=VALUE"},
        {"--params", &words.params,
         "use the parameters in this file, which the console's save has written; by path or name", "FILE.lua"},
        {"--threads", &words.threads, "number of threads for behaviours (default 1); the result is the same", "N"},
        {"--history", &words.history,
         "minutes of values kept for plots (default 1), up to 256 MB; then the oldest are dropped", "MINUTES"},
        {"--profile",
         &words.profile,
         "measure what behaviours cost: a table at the end, and a flame graph of their lines, or JSON for speedscope "
         "and Perfetto",
         "FILE.svg|json",
         {},
         FileUse::result},
        {"--keep-going", &words.keep_going,
         "leave out a behaviour that can't be loaded, with its connections, and run the others"},
        {"--trace-hash", &words.trace_hash, "print a hash of all published messages: equal runs have equal hashes"},
        {"--picture",
         &words.picture,
         "draw the arena, the robots and their paths when the run ends",
         "FILE.png|svg",
         {},
         FileUse::result},
        {"--record",
         &words.record,
         "write what ports publish: FILE.csv has a row for every tick; FILE.mcap is for programs of ROS 2, has truth, "
         "parameters, state, log and journal too, and repeats the run as `nezumi run FILE.mcap`",
         "FILE.csv|mcap",
         {},
         FileUse::result},
        {"--ports", &words.ports,
         "with --record: only these, in this order: ports, truth, config, state, or parts of them, as in "
         "mouse.truth.pose; * and ? stand for any characters, as in \"wander_*.out\" (default: all out-ports)",
         "NAME.WHAT,..."},
        {"--every", &words.every, "with --record: only one tick of N (default 1)", "N"},
        {"--journal",
         &words.journal,
         "write a journal to OUT: each act (change of the running system) with its tick",
         "OUT",
         {},
         FileUse::result},
        {"--replay",
         &words.replay,
         "repeat the run of a journal, as fast as possible unless --speed is given; it can be watched, but not "
         "changed. "
         "It ends at the same time and for the same reason. No other file is read",
         "OUT",
         {},
         FileUse::source},
        {"--sounds", &words.sounds, "write speech and tones of robots as WAV files into this folder", "DIR"},
        {"--dev-root", &words.dev_root, "with --hw: the folder of the device files (default /dev)", "DIR"},
        {"--sys-root", &words.sys_root, "with --hw: the folder of the kernel's devices (default /sys)", "DIR"},
        {"--device-log",
         &words.device_log,
         "with --hw: log to this file everything that the robots' drivers read and write",
         "FILE",
         {},
         FileUse::result},
        {"--device-log-play",
         &words.played_log,
         "with --hw: a device log replaces the robots, and everything written to devices is compared with it",
         "FILE",
         {},
         FileUse::source},
    };
}

std::vector<Option> open_options(RunWords& words) {
    words.opens_replay = true;
    std::vector<Option> options{
        {"RUN",
         &words.replay,
         "a journal or a recording, which `nezumi run` wrote with --journal OUT or --record OUT.mcap; a recording of "
         "ROS 2 in MCAP; the folder of a failed scenario",
         "",
         {},
         FileUse::source}};
    constexpr std::string_view same[] = {"--batch",  "--speed",         "--port",    "--no-web", "--open",
                                         "--listen", "--page-on-input", "--threads", "--history"};
    for (Option& each : run_options(words)) {
        if (std::find(std::begin(same), std::end(same), each.name) != std::end(same))
            options.push_back(std::move(each));
    }
    return options;
}

Expected<RunOptions> read_run_options(const RunWords& typed) {
    RunWords words = typed;
    const bool is_run = words.file.ends_with(".mcap") || words.file.ends_with(".journal");
    if (words.replay.empty() && is_run) words.replay = std::exchange(words.file, {});
    const bool repeats = !words.replay.empty() && !words.opens_replay;
    RunOptions options{.file = words.file,
                       .headless = words.headless || words.batch,
                       .stopped = words.stopped,
                       .batch = words.batch,
                       .keep_going = words.keep_going,
                       .trace_hash = words.trace_hash,
                       .real_time = words.real_time};
    if (words.file.empty() && words.replay.empty()) return failure("FILE is missing; see nezumi run --help");
    if (words.speed == "max" || (words.speed.empty() && (words.batch || repeats))) {
        options.speed = as_fast_as_possible;
    } else if (!words.speed.empty()) {
        const auto speed = number_in<double>(words.speed);
        if (!speed || !std::isfinite(*speed) || !check_speed(*speed))
            return wrong("--speed", fmt::format("a factor from {} to {:.0f}, or max", slowest_speed, fastest_speed),
                         words.speed);
        options.speed = *speed;
    }
    if (!words.duration.empty()) {
        const auto duration = number_in<double>(words.duration);
        if (!duration || !(*duration >= 0 && *duration <= longest))
            return wrong("--duration", fmt::format("seconds from 0 to {:.0f}", longest), words.duration);
        options.duration = *duration;
    }
    if (!words.seed.empty()) {
        options.seed = number_in<std::uint64_t>(words.seed);
        if (!options.seed) return wrong("--seed", "a whole number from 0 to 2^64 - 1", words.seed);
    }
    if (!words.history.empty()) {
        options.history = number_in<double>(words.history);
        if (!options.history || !(*options.history >= 1 && *options.history <= longest_history))
            return wrong("--history", fmt::format("minutes from 1 to {:.0f}", longest_history), words.history);
    }
    if (!words.threads.empty()) {
        const auto threads = number_in<int>(words.threads);
        if (!threads || *threads < 1 || *threads > most_threads)
            return wrong("--threads", fmt::format("a whole number from 1 to {}", most_threads), words.threads);
        options.threads = *threads;
    }
    if (options.real_time && !std::isfinite(options.speed))
        return failure("--realtime: works only in real time: leave it out, or give --speed a number");
    if (options.real_time && options.threads > 1)
        return failure("--realtime: works only with a single thread: leave out --threads");
    if (!words.picture.empty() && !is_picture_name(words.picture))
        return wrong("--picture", "a file name that ends in .png or .svg", words.picture);
    options.picture = words.picture;
    if (!words.profile.empty() && !words.profile.ends_with(".svg") && !words.profile.ends_with(".json"))
        return wrong("--profile", "a file name that ends in .svg or .json", words.profile);
    options.profile = words.profile;
    if (words.record.ends_with(".gz"))
        return wrong("--record", "a file of plain CSV, to be compressed by gzip when the run is over", words.record);
    const std::string ending = std::filesystem::path(words.record).extension();
    // Names of pipes and devices have no ending: they get CSV.
    if (!ending.empty() && ending != ".csv" && ending != ".mcap")
        return wrong("--record", "a file name that ends in .csv or .mcap", words.record);
    options.record = words.record;
    if (!words.every.empty()) {
        if (words.record.empty()) return failure("--every needs --record: give --record FILE.csv as well");
        const auto every = number_in<std::int64_t>(words.every);
        if (!every || *every < 1 || *every > 1'000'000)
            return wrong("--every", "a whole number from 1 to 1000000", words.every);
        options.every = *every;
    }
    options.sounds = words.sounds;
    options.journal = words.journal;
    if (words.keep_going && !words.journal.empty())
        return failure("--keep-going: a journal needs a system that loads completely: leave out --journal");
    options.replay = words.replay;
    options.opens_replay = words.opens_replay;
    options.values = {.file = words.params, .set = words.set};
    for (const auto& [option, given] : {std::pair{"--batch", words.batch},
                                        {"--seed", !words.seed.empty()},
                                        {"--duration", !words.duration.empty()},
                                        {"--journal", !words.journal.empty()},
                                        {"--set", !words.set.empty()},
                                        {"--params", !words.params.empty()},
                                        {"--stopped", words.stopped}}) {
        if (repeats && given) return failure(fmt::format("--replay repeats the journal: leave out {}", option));
    }
    if (!words.ports.empty()) {
        if (words.record.empty())
            return failure("--ports chooses what --record writes: give --record FILE.csv as well");
        auto ports = split("--ports", "names of ports as in mouse.ir_sensor_out,controller.out", words.ports);
        if (!ports) return Unexpected(ports.error());
        options.ports = std::move(*ports);
    }
    auto hardware = read_hardware(words);
    if (!hardware) return Unexpected(hardware.error());
    options.hardware = std::move(*hardware);
    auto web = read_web(words, options.headless);
    if (!web) return Unexpected(web.error());
    options.web = *web;
    if (repeats) {
        options.only_repeats = fmt::format(
            "a run that is repeated can't be changed: nezumi open {} can go back in it "
            "and change it",
            shown(options.replay));
        if (options.web) options.web->only_shows = options.only_repeats;
    }
    return options;
}

}  // namespace nezumi::cli
