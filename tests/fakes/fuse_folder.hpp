// Serves files of a program as a folder, by FUSE.
#pragma once

#include <string>

#include "tests/fakes/served_files.hpp"

namespace nezumi::fakes {

/// Serves until a signal (SIGTERM, SIGINT) or an unmount. Calls `ready` when the files are there. Returns the exit
/// status: 0, or 1 when it could not be mounted.
int serve_folder(const std::string& mount_point, ServedFiles& files, void (*ready)());

}  // namespace nezumi::fakes
