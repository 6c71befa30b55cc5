// The simulated world: the public interface of sim/.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "engine/world/world.hpp"

namespace nezumi::sim {

/// Makes a simulated world with this arena; a `WorldFactory`. Worlds are independent: a process may have several, also
/// on different threads, and the same calls give the same bits. Fails if an object of the arena has no size, if a
/// movable object overlaps another by more than 1 mm, or if the step is not positive. `warn` gets each message of the
/// physics library once.
Expected<std::unique_ptr<World>> make_world(const ArenaSpec& arena, const PhysicsSpec& physics,
                                            std::function<void(const std::string&)> warn);

/// Makes worlds with sounds: what robots say is written as WAV files (`SoundFiles`) to this folder, which is made if
/// missing. Fails if that is not possible.
WorldFactory make_worlds_with_sound(std::string folder);

}  // namespace nezumi::sim
