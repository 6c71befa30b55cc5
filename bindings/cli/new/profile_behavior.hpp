// Behaviours from RTCBuilder's profiles, and profiles of behaviours.
#pragma once

#include <string>
#include <vector>

#include "bindings/cli/new/behavior_text.hpp"
#include "bindings/lua/script/script.hpp"
#include "bindings/openrtm/component_profile.hpp"
#include "engine/messages/message_files.hpp"

namespace nezumi::cli {

/// The parts of a behaviour. `messages` finds its ports' types. What has no counterpart in it is a comment, and a line
/// of `remarks`: a type that is unknown, a name that is taken, and the profile's own remarks.
BehaviorParts parts_of(const openrtm::ComponentProfile& profile, const MessageFinder& messages,
                       std::vector<std::string>& remarks);

/// The profile of a behaviour that is loaded. What a profile can't have is a line of its remarks.
openrtm::ComponentProfile profile_of(Script& script);

}  // namespace nezumi::cli
