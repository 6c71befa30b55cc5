// Performs acts that change a system, but not its description.
#pragma once

#include <string_view>

#include "engine/system/act.hpp"
#include "engine/system/system.hpp"

namespace nezumi {

// Call these between two ticks. After an error nothing has changed, except for what a callback or command of a script
// did before it failed.
Expected<ActResult> perform(System& system, const SetParameter& act, const Actor& who);
Expected<ActResult> perform(System& system, const Write& act, const Actor& who);
Expected<ActResult> perform(System& system, const Inject& act, const Actor& who);
/// A `Write` or an `Inject` for a port that was found before.
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

/// A robot, and the world that knows its true pose: the simulation, or a test rig.
struct SeenRobot {
    const Robot* robot;
    const World* world;
    RobotId id;  ///< in this world
};

/// The robot of a component, in a world that knows its true pose; otherwise the error.
Expected<SeenRobot> seen_robot(const System& system, const Component& component);

/// The end of the message about a real robot that no test rig sees.
inline constexpr std::string_view not_seen = " is a real robot, whose true pose is not known";

}  // namespace nezumi
