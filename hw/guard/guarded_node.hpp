// A node that the guard stops: by its own descriptor, or by its path.
#pragma once

#include "hw/guard/guard_process.hpp"

namespace nezumi::hw {

/// Allocates nothing.
struct GuardedNode {
    int file = -1;  ///< the guard's own descriptor, open for writing; -1: no node
    GuardOrder::Node what{};
};

/// Replaces a node and closes its descriptor.
void take_up(GuardedNode& node, const GuardOrder::Node& what, int file);
/// Why the guard could not stop the node now, as an `errno`; 0 if its proof succeeds.
int problem_of(const GuardedNode& node);
/// Stops the node.
void stop(const GuardedNode& node);

}  // namespace nezumi::hw
