// Where this program is installed.
#pragma once

#include <filesystem>

namespace nezumi {

/// This program's own file; what belongs to it is beside its folder, in ../share and ../lib. Empty if it is unknown.
std::filesystem::path own_program();

}  // namespace nezumi
