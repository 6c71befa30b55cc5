// Commands that go back in time. The past is computed between two ticks, in slices.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/console/console_commands.hpp"
#include "bindings/console/console_fields.hpp"
#include "bindings/lua/files/read_options.hpp"
#include "bindings/lua/sandbox/watchdog.hpp"
#include "engine/live/past_execution.hpp"

namespace nezumi {

/// A row of the result of `branches`.
struct BranchRow {
    static constexpr std::string_view type_name = "branch";
    std::string name;
    std::string parent;  ///< the branch from which it branched off; "" for the first
    double left;         ///< [s] when it branched off
    double ends;         ///< [s] its end, since its last start
    bool present;        ///< whether the system is on this branch
};

namespace {

using Clock = PastRun::Clock;

// The longest time of a slice. Other users wait during a slice.
constexpr std::chrono::milliseconds slice{5};
// Progress is shown if the computation takes longer than this.
constexpr std::chrono::milliseconds patience{300};

std::int64_t tick_at(const RunningSystem& live, double seconds) {
    return std::llround(seconds * live.system().settings().rate);
}

double seconds_at(const RunningSystem& live, const ActTime& when) {
    return static_cast<double>(when.tick) / live.system().settings().rate;
}

std::string told(const RunningSystem& live) {
    const RunHistory::Branch& branch = live.history().branches()[live.history().current()];
    const std::string start = branch.end.start == 1 ? "" : fmt::format(", start {}", live.starts());
    return fmt::format("at {:g} s of {}{}, paused{}", live.system().now().seconds, branch.name, start,
                       live.is_past() ? ": resume() repeats what followed, every change begins a new branch" : "") +
           (live.is_away() ? "; other programs wait: resume { live = true } comes back to them" : "");
}

}  // namespace

Expected<bool> compute_past(Session::Parts& parts, PastRun& run, std::string_view what) {
    const auto begin = Clock::now();
    int shown_percent = -1;
    Expected<bool> there = false;
    const bool whole = parts.worker.perform([&] {
        const ActTime before = run.system().when();
        const bool is_beside = Worker::has_thread && !parts.clock.is_paused();
        there = is_beside ? run.go_on_beside(parts.worker.until()) : run.go_on(Clock::now() + slice);
        const int percent = static_cast<int>(100 * run.progress());
        // Only a console with keys, so with a person, gets the progress.
        if (parts.options.output.take_keys && Clock::now() - begin > patience && percent != shown_percent) {
            if (shown_percent < 0) give_keys(parts, true);
            parts.show_in_place(fmt::format("{}: {} %, Esc cancels", what, percent));
            shown_percent = percent;
        }
        const bool ended = !there || *there;
        if (ended) give_keys(parts, false);
        // The next slice comes at once, or after the next tick if there was no time for one.
        if (!ended && run.system().when() != before) parts.bell().ring();
        return ended;
    });
    if (!whole) return failure("interrupted");
    if (!there) return Unexpected(there.error());
    return shown_percent >= 0;
}

namespace {

// Goes to the moment that `find` returns. `find` is called between two ticks.
template <class Find>
Expected<CommandEnd> go_to(Session::Parts& parts, const Find& find) {
    // This time must not count as time of the user's script.
    const CallPause pause;
    auto past = parts.at_system([&]() -> std::optional<Expected<std::unique_ptr<PastRun>>> {
        if (parts.clock.is_hardware()) return failure("real robots can't go back in time");
        const Expected<Seek> where = find();
        if (!where) return Unexpected(where.error());
        auto begun = parts.live.begin_seek(*where);
        if (begun) parts.clock.pause();
        return begun;
    });
    if (!past) return failure("interrupted");
    if (!*past) return Unexpected(past->error());
    PastRun& run = ***past;
    const auto computed = compute_past(parts, run);
    if (!computed) return Unexpected(computed.error());
    std::string text;
    const auto done = parts.at_system([&] {
        auto gone = std::make_optional(parts.live.commit(run, parts.options.who));
        if (*gone) text = told(parts.live);
        return gone;
    });
    if (!done) return failure("interrupted");
    if (!*done) return Unexpected(done->error());
    *computed ? parts.show_in_place(text) : parts.show(text);
    return CommandEnd::done;
}

// Goes back to the present if other programs wait there. An error if the run is in the past and no program waits.
Expected<void> come_back(Session::Parts& parts) {
    RunningSystem& live = parts.live;
    if (live.is_away()) return live.act(live.back(), parts.options.who).map([](const ActResult&) {});
    if (!live.is_past()) return {};
    return failure(
        fmt::format("live is only for runs with other programs that wait: seek \"{}\" goes to the end of this branch",
                    live.history().branches()[live.history().current()].name));
}

}  // namespace

void give_keys(Session::Parts& parts, bool to_seek) {
    if (!parts.options.output.take_keys || parts.seek_has_keys == to_seek) return;
    parts.seek_has_keys = to_seek;
    parts.options.output.take_keys(to_seek ? TakenKeys::escape : TakenKeys::none);
}

Expected<CommandEnd> explain_failure(Session::Parts& parts, const std::string& name) {
    const CallPause pause;
    const auto past = parts.at_system([&] { return std::make_optional(PastExecution::begin(parts.live, name)); });
    if (!past) return failure("interrupted");
    if (!*past) return Unexpected(past->error());
    PastExecution& execution = ***past;
    if (auto computed = compute_past(parts, execution.run()); !computed) return Unexpected(computed.error());
    // This command owns the past system, but only the ticking thread may use it.
    const auto explained = parts.at_system([&] { return std::make_optional(execution.explain()); });
    if (!explained) return failure("interrupted");
    if (!*explained) return Unexpected(explained->error());
    parts.show(fmt::format("the execution that failed, at {:g} s:\n{}", execution.seconds(), to_text(**explained)));
    return CommandEnd::done;
}

Expected<CommandEnd> command_seek(Session::Parts& parts, const Arguments& arguments) {
    const bool has_branch = arguments.kind(1) == "string";
    std::string branch;
    std::optional<double> seconds;
    if (has_branch) {
        const auto name = arguments.text(1, "the name of a branch");
        if (!name) return Unexpected(name.error());
        branch = *name;
    }
    if (!has_branch && arguments.has(2)) return failure("expected one time, or a branch and a time");
    if (!has_branch || arguments.has(2)) {
        const auto given = arguments.number(has_branch ? 2 : 1, "a time in seconds");
        if (!given) return Unexpected(given.error());
        if (!(*given >= 0 && *given < 1e9))
            return failure(fmt::format("expected a time from 0 to 1e9 seconds, got {:g}", *given));
        seconds = *given;
    }
    return go_to(parts, [&]() -> Expected<Seek> {
        return Seek{.branch = branch, .tick = seconds ? tick_at(parts.live, *seconds) : -1};
    });
}

Expected<CommandEnd> command_rewind(Session::Parts& parts, const Arguments& arguments) {
    const auto seconds = arguments.number(1, "seconds");
    if (!seconds) return Unexpected(seconds.error());
    if (!(*seconds >= 0)) return failure(fmt::format("expected seconds from 0 on, got {:g}", *seconds));
    return go_to(parts, [&]() -> Expected<Seek> {
        const std::int64_t back = tick_at(parts.live, std::min(*seconds, 1e9));
        Seek where{.tick = parts.live.system().now().tick - back, .start = parts.live.starts()};
        // A time before the start of this run is counted back from the end of the start before.
        while (where.tick < 0) {
            const auto end = where.start > 1
                                 ? parts.live.history().end_of_start(where.start - 1, parts.live.history().current())
                                 : std::nullopt;
            if (!end) {
                return failure(
                    fmt::format("only {:g} s have passed since the start",
                                static_cast<double>(where.tick + back) / parts.live.system().settings().rate));
            }
            where.tick += *end;
            --where.start;
        }
        return where;
    });
}

Expected<CommandEnd> command_resume(Session::Parts& parts, const Arguments& arguments) {
    ResumeOptions options;
    if (arguments.has(1)) {
        if (arguments.kind(1) != "table") return failure("expected resume() or resume { live = true }");
        if (auto ok = read_options(arguments.lua, arguments.index(1), FieldCheck::of_options("options"), options); !ok)
            return Unexpected(ok.error());
    }
    const auto done = parts.at_system([&]() -> std::optional<Expected<void>> {
        if (options.live) {
            if (auto back = come_back(parts); !back) return back;
            if (parts.options.batch) return Expected<void>();
        }
        if (parts.options.batch)
            return failure(
                "expected seconds, as in run(1): in a batch of commands, time moves only by step(n) and run(seconds)");
        parts.clock.resume();
        return Expected<void>();
    });
    if (!done) return failure("interrupted");
    if (!*done) return Unexpected(done->error());
    return CommandEnd::done;
}

Expected<CommandEnd> command_branches(Session::Parts& parts, const Arguments& /*arguments*/) {
    const RunHistory& history = parts.live.history_until_now();
    std::vector<BranchRow> rows;
    for (std::size_t index = 0; index < history.branches().size(); ++index) {
        const RunHistory::Branch& branch = history.branches()[index];
        rows.push_back({.name = branch.name,
                        .parent = index == 0 ? "" : history.branches()[branch.parent].name,
                        .left = seconds_at(parts.live, branch.left),
                        .ends = branch.seconds,
                        .present = index == history.current()});
    }
    parts.value = std::move(rows);
    return CommandEnd::value;
}

}  // namespace nezumi
