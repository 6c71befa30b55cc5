// What there is to say of a component, a port, a parameter or a member to somebody who asks what it is.
#pragma once

#include <string>

#include "engine/tree/node.hpp"

namespace nezumi {

/// Explains a component, one of its ports, parameters, commands and members, or a member of a port, over several lines.
/// A part of a value is explained with the whole.
std::string help_text(const TreeNode& node);

}  // namespace nezumi
