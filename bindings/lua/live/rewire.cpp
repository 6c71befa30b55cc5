// Who sees what a system wants of RTCs makes it so.
#include "bindings/lua/live/rewire.hpp"

#include <fmt/format.h>

#include "engine/system/perform.hpp"
#include "engine/system/rtm_wiring.hpp"

namespace nezumi {

Expected<ActResult> rewire(System& system, SystemSpec& spec, const Connect& act, const Actor& who) {
    if (!is_rtm_path(act.from) && !is_rtm_path(act.to)) return perform(system, act, who);
    if (auto made = connect_rtm(spec, system, act.from, act.to); !made) return Unexpected(made.error());
    return ActResult{};
}

Expected<ActResult> rewire(System& system, SystemSpec& spec, const Disconnect& act, const Actor& who) {
    const bool was_there = disconnect_rtm(spec, act.from, act.to) > 0;
    if (is_rtm_path(act.from) || is_rtm_path(act.to)) {
        if (was_there) return ActResult{};
        const std::string missing = act.to.empty() ? "" : " to " + shown(act.to);
        return failure(fmt::format("{} is not connected{}", shown(act.from), missing));
    }
    auto done = perform(system, act, who);
    return was_there ? ActResult{} : done;
}

}  // namespace nezumi
