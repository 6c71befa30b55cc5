// Parts of the program that are loaded when they are first used: libraries that would cost every start too much.
#pragma once

#include <string>
#include <string_view>

#include "engine/base/error.hpp"

namespace nezumi {

/// A function of a module: a library of its own in the program's folder for libraries.
struct Module {
    std::string_view file;      ///< "nezumi_camera.so"
    std::string_view function;  ///< which throws nothing
    std::string_view part;      ///< what it is for, in errors: "cameras"
    std::string_view needs;     ///< the package without which it can't be loaded
};

/// Whether this program was built with a module. A static program, which can load nothing, has none.
bool is_built_with(const Module& module);

/// Loads a module and finds its function; it stays until the program ends. An error says what to install, or that this
/// program was built without the module.
Expected<void*> load_function(const Module& module);

}  // namespace nezumi
