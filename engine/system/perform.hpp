// Performs the acts that change a system and not its description.
#pragma once

#include <string_view>

#include "engine/system/act.hpp"
#include "engine/system/system.hpp"

namespace nezumi {

// Each between two ticks. On an error nothing has changed, but for what a script's own hook or command did before it
// failed.
Expected<ActResult> perform(System& system, const SetParameter& act, const Actor& who);
Expected<ActResult> perform(System& system, const Write& act, const Actor& who);
Expected<ActResult> perform(System& system, const Inject& act, const Actor& who);
/// A `Write` or an `Inject` of a port that was found before.
Expected<ActResult> deliver(Port& port, const Act& act);
Expected<ActResult> perform(System& system, const Hold& act, const Actor& who);
Expected<ActResult> perform(System& system, const Release& act, const Actor& who);
Expected<ActResult> perform(System& system, const Drop& act, const Actor& who);
Expected<ActResult> perform(System& system, const Freeze& act, const Actor& who);
Expected<ActResult> perform(System& system, const Activate& act, const Actor& who);
Expected<ActResult> perform(System& system, const Deactivate& act, const Actor& who);
Expected<ActResult> perform(System& system, const Reset& act, const Actor& who);
Expected<ActResult> perform(System& system, const Use& act, const Actor& who);
Expected<ActResult> perform(System& system, const Connect& act, const Actor& who);
Expected<ActResult> perform(System& system, const Disconnect& act, const Actor& who);
Expected<ActResult> perform(System& system, const Teleport& act, const Actor& who);
Expected<ActResult> perform(System& system, const Disturb& act, const Actor& who);
Expected<ActResult> perform(System& system, const Press& act, const Actor& who);
Expected<ActResult> perform(System& system, const Command& act, const Actor& who);
Expected<ActResult> perform(System& system, const Stop& act, const Actor& who);
Expected<ActResult> perform(System& system, const Rearm& act, const Actor& who);

/// A robot, and the world that knows the truth about it: the simulated one, or what a test rig sees.
struct SeenRobot {
    const Robot* robot;
    const World* world;
    RobotId id;  ///< in that world
};

/// The robot that this component is, in a world that knows the truth; else why not.
Expected<SeenRobot> seen_robot(const System& system, const Component& component);

/// What is said of a real robot, after its name, where there could be a rig that sees it and is none.
inline constexpr std::string_view not_seen = " is a real robot, whose true pose is not known";

}  // namespace nezumi
