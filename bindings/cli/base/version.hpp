// The version of this program. A journal of another version may differ when it is replayed, a project can be pushed
// only to a robot with the same version, and results of runs belong to the version that made them.
#pragma once

namespace nezumi::cli {

/// "1.2.3", a constant of the program.
const char* version();

}  // namespace nezumi::cli
