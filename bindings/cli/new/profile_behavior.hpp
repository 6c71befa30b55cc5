// Behaviours from RTCBuilder's profiles, and profiles of behaviours.
#pragma once

#include <string>
#include <vector>

#include "bindings/cli/new/behavior_text.hpp"
#include "bindings/lua/script/script.hpp"
#include "bindings/openrtm/component_profile.hpp"
#include "engine/messages/message_files.hpp"

namespace nezumi::cli {

/// The parts of a behaviour from a profile. `messages` finds the types of its ports. Things that a behaviour can't have
/// become comments and lines of `remarks`: an unknown type, a name that is taken, and the profile's own remarks.
BehaviorParts parts_of(const openrtm::ComponentProfile& profile, const MessageFinder& messages,
                       std::vector<std::string>& remarks);

/// The profile of a loaded behaviour. Things that a profile can't have become lines of its remarks.
openrtm::ComponentProfile profile_of(Script& script);

}  // namespace nezumi::cli
