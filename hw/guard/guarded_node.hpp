// A node that the guard stops: by its own descriptor, or where it is found by its path.
#pragma once

#include "hw/guard/guard_process.hpp"

namespace nezumi::hw {

/// Nothing of it allocates.
struct GuardedNode {
    int file = -1;  ///< the guard's own descriptor, open for writing; -1: there is no such node
    GuardOrder::Node what{};
};

/// Puts a node in place of another, whose descriptor is closed.
void take_up(GuardedNode& node, const GuardOrder::Node& what, int file);
/// Why the guard could not stop it now, as `errno`; 0: it could, so far as its proof tells.
int problem_of(const GuardedNode& node);
/// Makes it stop.
void stop(const GuardedNode& node);

}  // namespace nezumi::hw
