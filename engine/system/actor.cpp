// Converts actors to text and back.
#include "engine/system/actor.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>

namespace nezumi {
namespace {

constexpr std::array<std::string_view, 8> actor_kinds{"run",         "console",  "scenario", "file watcher",
                                                      "spreadsheet", "joystick", "browser",  "network"};

}  // namespace

std::string to_text(const Actor& who) {
    const std::string_view kind = actor_kinds[static_cast<std::size_t>(who.kind)];
    return who.name.empty() ? std::string(kind) : fmt::format("{} {}", kind, who.name);
}

Expected<Actor> actor_from(std::string_view text) {
    for (std::size_t i = 0; i < actor_kinds.size(); ++i) {
        const std::string_view kind = actor_kinds[i];
        if (!text.starts_with(kind)) continue;
        const std::string_view rest = text.substr(kind.size());
        if (rest.empty()) return Actor{static_cast<Actor::Kind>(i)};
        if (rest.front() == ' ') return Actor{static_cast<Actor::Kind>(i), std::string(rest.substr(1))};
    }
    return failure(
        fmt::format("'{}' is not a kind of actor: expected one of {}", shown(text), fmt::join(actor_kinds, ", ")));
}

}  // namespace nezumi
