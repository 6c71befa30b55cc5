// A link of the kernel: a confined program may read it too.
#include "engine/base/own_program.hpp"

#include <system_error>

namespace nezumi {

std::filesystem::path own_program() {
    std::error_code none;
    return std::filesystem::read_symlink("/proc/self/exe", none);
}

}  // namespace nezumi
