// The simulated world: the door of this room.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "engine/world/world.hpp"

namespace nezumi::sim {

/// Makes a simulated world with this arena in it; a `WorldFactory`. Worlds don't disturb each other: any number may run
/// in a process, also on different threads, and the same calls give the same bits. An error when something of the arena
/// has no extent, when what can move lies deeper than 1 mm in something else, or when the step is not positive. `warn`
/// gets what the physics has to say, each sentence once.
Expected<std::unique_ptr<World>> make_world(const ArenaSpec& arena, const PhysicsSpec& physics,
                                            std::function<void(const std::string&)> warn);

/// The same for worlds in which what robots say becomes WAV files in this folder (`SoundFiles`), which is made when it
/// is not there. An error when it can't be.
WorldFactory make_worlds_with_sound(std::string folder);

}  // namespace nezumi::sim
