// How many threads OpenCV may take.
#pragma once

namespace nezumi {

/// From now on OpenCV works in the thread that calls it, in the whole program: a picture costs one core, as others run
/// behaviours. What is seen does not depend on it. Returns true.
bool use_one_thread();

}  // namespace nezumi
