// The version of this nezumi. A journal is replayed by the version that wrote it; a project goes to a robot that has
// the same; results of runs are of the version that made them.
#pragma once

namespace nezumi::cli {

/// "1.2.3", a constant of the program.
const char* version();

}  // namespace nezumi::cli
