// A folder for the consoles' sockets of a test's own programs.
#pragma once

#include <cstdlib>
#include <optional>
#include <string>

#include "tests/unit/lua/scratch_folder.hpp"

namespace nezumi::hw {

// A folder of its own for the program's socket.
struct OwnSockets {
    OwnSockets() {
        if (const char* given = std::getenv("XDG_RUNTIME_DIR")) before = given;
        setenv("XDG_RUNTIME_DIR", folder.path("").c_str(), 1);
    }
    ~OwnSockets() { before ? setenv("XDG_RUNTIME_DIR", before->c_str(), 1) : unsetenv("XDG_RUNTIME_DIR"); }
    OwnSockets(const OwnSockets&) = delete;
    OwnSockets& operator=(const OwnSockets&) = delete;

    Scratch folder;
    std::optional<std::string> before;
};

}  // namespace nezumi::hw
