// Reads anything as a system file: what comes out is sound, or an error that is one line with a place.
#include <cmath>
#include <cstdint>
#include <string_view>

#include "bindings/cli/base/environment.hpp"
#include "bindings/lua/files/system_file.hpp"
#include "engine/base/names.hpp"
#include "engine/base/schedule.hpp"
#include "tests/fuzz/require.hpp"

using namespace nezumi;

namespace {

void check(const RobotEntry& robot, const SystemSpec& spec) {
    require(spec.models.contains(robot.model));
    require(std::isfinite(robot.pose.position.x) && std::isfinite(robot.pose.position.y) &&
            std::isfinite(robot.pose.heading));
    const LimitChanges& limits = robot.limits;
    for (const auto& limit : {limits.speed, limits.yaw_rate, limits.acceleration, limits.yaw_acceleration})
        require(!limit || *limit > 0);
}

void check(const BehaviorEntry& behavior, const SystemSpec& spec) {
    require(!behavior.path.empty() && behavior.rate >= 0 && behavior.rate <= spec.rate);
    require(behavior.set.empty() || behavior.sets.contains(behavior.set));
}

void check(const ComponentEntry& component, const SystemSpec& spec) {
    require(!component.type.empty() || spec.entries.size() > 0);
    require(component.rate >= 0 && component.rate <= spec.rate && is_finite(component.at) &&
            std::isfinite(component.yaw));
}

void check(const SystemSpec& spec) {
    require(steps_per_tick(spec.rate, spec.physics_step).has_value());
    for (const Entry& entry : spec.entries) {
        require(is_identifier(name_of(entry)) && !is_reserved_name(name_of(entry)) && place_of(entry).line > 0);
        std::visit([&](const auto& e) { check(e, spec); }, entry);
    }
    for (const BoxSpec& box : spec.arena.boxes) {
        require(is_finite(box.at) && is_finite(box.size) && std::isfinite(box.yaw) && std::isfinite(box.pitch));
        require(box.size.x > 0 && box.size.y > 0 && box.size.z > 0 && box.mass >= 0 && box.place.line > 0);
    }
    for (const CylinderSpec& cylinder : spec.arena.cylinders) {
        require(is_finite(cylinder.at) && cylinder.radius > 0 && cylinder.height > 0 && cylinder.mass >= 0);
    }
    for (const MarkerSpec& marker : spec.arena.markers)
        require(is_finite(marker.at) && marker.size > 0 && marker.id >= 0);
    if (spec.arena.size) require(spec.arena.size->x > 0 && spec.arena.size->y > 0);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Project project = Project::of("behaviors/systems/any.lua", {"."});
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto spec = read_system_text(text, "behaviors/systems/any.lua", project,
                                       {.seconds = 0.02, .peer_words = cli::peer_words()});
    spec ? check(*spec) : check(spec.error());
    return 0;
}
