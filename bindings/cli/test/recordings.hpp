// The recorded runs that scenarios test, and by which they judge behaviours.
#pragma once

#include "bindings/scenario/recordings.hpp"

namespace nezumi::cli {

/// Journals, recordings of nezumi, and those of ROS 2.
const Recordings& recordings();

}  // namespace nezumi::cli
