// The robot's side of a push.
#pragma once

#include "bindings/push/connection.hpp"

namespace nezumi::push {

/// Takes a project from the other side (`send_project`), which is told what went wrong. Returns whether all went well.
/// A connection that breaks before the commit leaves the robot's files as they were; afterwards it changes nothing.
bool receive_project(const PushConnection& connection);

/// How long the other side may say nothing [ms]: a laptop that has left the network must not lock the folder.
inline constexpr int longest_silence = 20'000;

}  // namespace nezumi::push
