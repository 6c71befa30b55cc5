// The number of threads that OpenCV uses.
#pragma once

namespace nezumi {

/// From now on OpenCV works only in the calling thread, in the whole program: a picture uses one core, because
/// behaviours need the others. Results do not depend on the number of threads. Returns true.
bool use_one_thread();

}  // namespace nezumi
