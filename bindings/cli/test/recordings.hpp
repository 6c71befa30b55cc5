// The recorded runs that scenarios look at and judge by.
#pragma once

#include "bindings/scenario/recordings.hpp"

namespace nezumi::cli {

/// Journals, recordings of nezumi, and those of ROS 2.
const Recordings& recordings();

}  // namespace nezumi::cli
