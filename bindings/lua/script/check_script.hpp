// Checks the file of a behaviour without running it in a system, for editors, `nezumi check` and CI.
#pragma once

#include <vector>

#include "bindings/lua/script/script.hpp"

namespace nezumi {

/// All errors of this text in order of location: all that reading finds; if there are none, all wrong declarations; if
/// there are none, the first error of loading; if there is none, all undeclared parameters that are used. Empty: it
/// loads.
std::vector<Error> check_behavior(const SourceText& source, const ScriptContext& context);

/// All errors in the text of a module, which is read but not run.
std::vector<Error> check_module(const SourceText& source);

}  // namespace nezumi
