// Checks the file of a behaviour without running it in a system, for editors, `nezumi check` and CI.
#pragma once

#include <vector>

#include "bindings/lua/script/script.hpp"

namespace nezumi {

/// The errors of the first of these steps that finds any, in order of location: compiling, declarations, loading (only
/// one error), use of undeclared parameters. Empty if the file loads without an error.
std::vector<Error> check_behavior(const SourceText& source, const ScriptContext& context);

/// All errors in the text of a module, which is compiled but not run.
std::vector<Error> check_module(const SourceText& source);

}  // namespace nezumi
