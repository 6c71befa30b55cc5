// What a page has in place of threads: everything happens in the one thread of a worker.
#pragma once

namespace nezumi::web {

/// Lets running systems find the files that were written.
void look_at_files();

}  // namespace nezumi::web
