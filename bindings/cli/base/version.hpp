// The version of this program. A replay may differ from a journal of another version, a project can be pushed only to a
// robot with the same version, and stored results are valid only for the version that made them.
#pragma once

namespace nezumi::cli {

/// Returns the version, such as "1.2.3".
const char* version();

}  // namespace nezumi::cli
