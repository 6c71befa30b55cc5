// Where this program is installed.
#pragma once

#include <filesystem>

namespace nezumi {

/// The file by which this program is started again; what belongs to it is beside its folder, in ../share and ../lib.
/// Empty if it can't be told. In a portable folder it is the script that starts the program with the folder's
/// libraries.
std::filesystem::path own_program();

}  // namespace nezumi
