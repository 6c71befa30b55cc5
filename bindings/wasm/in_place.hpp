// Replaces threads in a web page: everything runs in the one thread of a worker.
#pragma once

namespace nezumi::web {

/// Checks all watched files for changes. Call it after files were written.
void look_at_files();

}  // namespace nezumi::web
