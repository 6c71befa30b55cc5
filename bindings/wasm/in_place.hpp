// What a page has in place of threads and sockets: everything happens in the one thread of a worker.
#pragma once

#include <functional>

namespace nezumi::web {

/// Runs one tick for a console command that waits for simulated time. Returns false if no tick comes.
using TickInPlace = std::function<bool()>;

/// Sets the function that commands of consoles wait by; empty: they fail.
void tick_in_place_by(TickInPlace tick);

/// Lets running systems find the files that were written.
void look_at_files();

}  // namespace nezumi::web
