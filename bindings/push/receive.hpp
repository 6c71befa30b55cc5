// The robot's side of a push.
#pragma once

#include "bindings/push/connection.hpp"

namespace nezumi::push {

/// Takes a project from the other side (`send_project`) and reports errors to the other side. Returns true on success.
/// If the connection breaks before the commit, the robot's files are unchanged; if it breaks later, the push is
/// finished nevertheless.
bool receive_project(const PushConnection& connection);

/// The longest silence of the other side [ms]: a laptop that has left the network must not keep the folder locked.
inline constexpr int longest_silence = 20'000;

}  // namespace nezumi::push
