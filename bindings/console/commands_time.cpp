// Commands that control time.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "bindings/console/console_commands.hpp"
#include "bindings/console/file_to_write.hpp"

namespace nezumi {
namespace {

Expected<void> refuse_hardware(const Session::Parts& parts) {
    if (parts.clock.is_hardware()) return failure("this works only in simulation: real robots always run in real time");
    return {};
}

CommandEnd advance(Session::Parts& parts, std::int64_t ticks) {
    parts.ticks = ticks;
    return CommandEnd::wait;
}

}  // namespace

Expected<CommandEnd> command_pause(Session::Parts& parts, const Arguments&) {
    parts.clock.pause();
    return CommandEnd::done;
}

Expected<CommandEnd> command_step(Session::Parts& parts, const Arguments& arguments) {
    if (auto ok = refuse_hardware(parts); !ok) return Unexpected(ok.error());
    double ticks = 1;
    if (arguments.has(1)) {
        const auto given = arguments.number(1, "a number of ticks");
        if (!given) return Unexpected(given.error());
        ticks = *given;
    }
    const auto checked = check_ticks(ticks);
    if (!checked) return Unexpected(checked.error());
    return advance(parts, *checked);
}

Expected<CommandEnd> command_run(Session::Parts& parts, const Arguments& arguments) {
    if (!arguments.has(1)) {
        if (parts.options.batch)
            return failure(
                "expected seconds, as in run(1): in a batch of commands, time moves only by step(n) and run(seconds)");
        parts.clock.resume();
        return CommandEnd::done;
    }
    if (auto ok = refuse_hardware(parts); !ok) return Unexpected(ok.error());
    const auto seconds = arguments.number(1, "seconds");
    if (!seconds) return Unexpected(seconds.error());
    if (!(*seconds > 0)) return failure(fmt::format("expected seconds greater than 0, got {}", *seconds));
    const double rate = parts.live.system().settings().rate;
    const auto checked = check_ticks(std::max(1.0, std::ceil(*seconds * rate - 1e-6)));
    if (!checked) return failure(fmt::format("expected at most {:.0f} seconds, got {}", most_ticks / rate, *seconds));
    return advance(parts, *checked);
}

Expected<CommandEnd> command_speed(Session::Parts& parts, const Arguments& arguments) {
    if (!arguments.has(1)) {
        parts.number = parts.clock.speed();
        return CommandEnd::number;
    }
    if (auto ok = refuse_hardware(parts); !ok) return Unexpected(ok.error());
    double factor = std::numeric_limits<double>::infinity();
    if (const auto text = arguments.text(1, ""); !text || *text != "max") {
        const auto given = arguments.number(1, "a number or \"max\"");
        if (!given) return Unexpected(given.error());
        factor = *given;
    }
    const auto speed = check_speed(factor);
    if (!speed) return Unexpected(speed.error());
    parts.clock.set_speed(*speed);
    return CommandEnd::done;
}

// Refuses a restart that would lose components that were added to the running system and are in no file.
Expected<void> check_lost(Session::Parts& parts, const std::vector<std::string>& names) {
    if (names.empty()) return {};
    const auto at = parts.at_system([&] {
        return std::make_optional(std::pair{parts.live.project(), parts.live.spec().file});
    });
    if (!at) return failure("interrupted");
    const auto& [project, file] = *at;
    // A restart reads only the system's own file, so the components must be saved to this file.
    const bool can_write = file_to_write(writable_folder(project, file), file, {.endings = {".lua"}}).has_value();
    const std::string how = can_write ? fmt::format("save \"{}\" keeps them in the system's file", file)
                                      : "save \"FILE.lua\" and run that file to keep them";
    return failure(fmt::format("{} would be lost: {}, restart \"anyway\" drops them", fmt::join(names, ", "), how));
}

Expected<CommandEnd> command_restart(Session::Parts& parts, const Arguments& arguments) {
    if (auto ok = refuse_hardware(parts); !ok) return Unexpected(ok.error());
    const bool anyway = arguments.has(1);
    if (anyway) {
        const auto how = arguments.text(1, "nothing, or \"anyway\"");
        if (!how) return Unexpected(how.error());
        if (*how != "anyway") return failure(fmt::format("expected nothing, or \"anyway\", got '{}'", shown(*how)));
    }
    const auto restarted = parts.act_beside(Restart{}, {}, [&](const PreparedAct& prepared) {
        return anyway ? Expected<void>() : check_lost(parts, prepared.lost);
    });
    if (!restarted) return Unexpected(restarted.error());
    parts.show("restarted, time is 0");
    return CommandEnd::done;
}

Expected<CommandEnd> command_quit(Session::Parts& parts, const Arguments&) {
    parts.jobs.clear();
    parts.quits = Worker::Clock::now();  // the run ends after the answer to this input
    return CommandEnd::done;
}

Expected<CommandEnd> command_now(Session::Parts& parts, const Arguments&) {
    parts.number = parts.live.system().now().seconds;
    return CommandEnd::number;
}

}  // namespace nezumi
