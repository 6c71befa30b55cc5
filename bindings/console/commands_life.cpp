// Commands that activate and deactivate components, and that set the log level.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/console/console_commands.hpp"

namespace nezumi {
namespace {

// The components that a command applies to: the given one, or all in this state, in the order of the system.
Expected<std::vector<std::string>> wanted(Session::Parts& parts, const Arguments& arguments, LifeState state) {
    using Names = std::vector<std::string>;
    return parts.at_system([&]() -> Expected<Names> {
        if (arguments.has(1)) {
            const auto at = parts.objects->to_component(arguments.lua, 1);
            return at ? Expected<Names>(Names{at->component->name()}) : Unexpected(at.error());
        }
        Names names;
        for (const auto& component : parts.live.system().components()) {
            if (component->state() == state) names.push_back(component->name());
        }
        return names;
    });
}

// Performs one act for each component, each between two ticks. Reports the components that succeeded, and the errors of
// the others.
template <class EachAct>
Expected<CommandEnd> act_on(Session::Parts& parts, const std::vector<std::string>& names, std::string_view done,
                            std::string_view none) {
    std::vector<std::string> acted, failed;
    for (const std::string& name : names) {
        const auto result = parts.at_system([&] { return std::make_optional(parts.act(EachAct{name})); });
        if (!result) return failure("interrupted");
        if (*result) {
            acted.push_back(name);
        } else {
            failed.push_back(describe(result->error()));
        }
    }
    if (!acted.empty()) parts.show(fmt::format("{}: {}", done, fmt::join(acted, ", ")));
    if (!failed.empty()) return failure(fmt::format("{}", fmt::join(failed, "\n")));
    if (acted.empty()) parts.show(none);
    return CommandEnd::done;
}

constexpr std::array levels{LogLevel::debug, LogLevel::info, LogLevel::warn, LogLevel::error};

}  // namespace

std::vector<std::string> log_level_names() {
    std::vector<std::string> names;
    names.reserve(levels.size());
    for (const LogLevel level : levels) names.emplace_back(to_text(level));
    return names;
}

Expected<CommandEnd> command_activate(Session::Parts& parts, const Arguments& arguments) {
    if (auto peer = peer_named(arguments, 1))
        return ask_peers(parts, {.what = PeerRequest::What::activate, .name = std::move(*peer)});
    const auto names = wanted(parts, arguments, LifeState::inactive);
    if (!names) return Unexpected(names.error());
    return act_on<Activate>(parts, *names, "ACTIVE now", "no component is INACTIVE");
}

Expected<CommandEnd> command_deactivate(Session::Parts& parts, const Arguments& arguments) {
    if (auto peer = peer_named(arguments, 1))
        return ask_peers(parts, {.what = PeerRequest::What::deactivate, .name = std::move(*peer)});
    auto names = wanted(parts, arguments, LifeState::active);
    if (!names) return Unexpected(names.error());
    // The last first, as at the end of a run: a behaviour stops before the robot that it drives.
    std::reverse(names->begin(), names->end());
    return act_on<Deactivate>(parts, *names, "INACTIVE now", "no component is ACTIVE");
}

Expected<CommandEnd> command_log_level(Session::Parts& parts, const Arguments& arguments) {
    const auto name = arguments.text(1, "a level, as in log_level \"debug\"");
    if (!name) return Unexpected(name.error());
    std::vector<std::string_view> names;
    for (const LogLevel level : levels) {
        names.push_back(to_text(level));
        if (names.back() != *name) continue;
        if (!parts.options.output.log_level || !parts.options.output.log_level(level))
            return failure("this console shows no log: use a terminal of `nezumi run` or `nezumi attach`");
        return CommandEnd::done;
    }
    const std::string near = did_you_mean(*name, names);
    return failure(fmt::format("there is no level '{}'{}", shown(*name),
                               near.empty() ? fmt::format(" (there are {})", fmt::join(names, ", ")) : near));
}

}  // namespace nezumi
