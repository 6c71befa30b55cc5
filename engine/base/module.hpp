// Parts of the program that are loaded at their first use, because their libraries would slow down every start.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "engine/base/error.hpp"

namespace nezumi {

/// The path of this program. Its data and libraries are in ../share and ../lib of its folder. Empty if it is unknown.
std::filesystem::path own_program();

/// A function of a module: a shared library in the program's library folder.
struct Module {
    std::string_view file;      ///< "nezumi_camera.so"
    std::string_view function;  ///< does not throw
    std::string_view part;      ///< what the module is for, in errors: "cameras"
    std::string_view needs;     ///< the package that the module needs
};

/// Whether this program was built with the module: whether its file exists. A static program has no modules.
bool is_built_with(const Module& module);

/// Loads a module and finds its function. The module stays loaded until the program ends. The error says what to
/// install, or that this program was built without the module.
Expected<void*> load_function(const Module& module);

}  // namespace nezumi
