// A link of the kernel, which a confined program may read too.
#include "engine/base/own_program.hpp"

#include <cstdlib>
#include <system_error>

namespace nezumi {

std::filesystem::path own_program() {
    // Where a script starts this program by a loader of its own, the kernel knows the loader only (.ci/portable).
    if (const char* script = std::getenv("NEZUMI_PROGRAM")) return script;
    std::error_code none;
    return std::filesystem::read_symlink("/proc/self/exe", none);
}

}  // namespace nezumi
