// The help text of a component, a port, a parameter or a member.
#pragma once

#include <string>

#include "engine/tree/node.hpp"

namespace nezumi {

/// Explains a component, one of its ports, parameters, commands or members, or a member of a port, in several lines. A
/// part of a value is explained with the whole value.
std::string help_text(const TreeNode& node);

}  // namespace nezumi
