// Says what is wrong with a behaviour's file without running it in a system: for editors, `nezumi check` and CI.
#pragma once

#include <vector>

#include "bindings/lua/script/script.hpp"

namespace nezumi {

/// Everything for which this text would be refused, in order of place: all diagnostics that can be found by reading it,
/// or else all declarations that are wrong, or else the first thing that its loading says, or else all parameters that
/// are read and not declared. Empty: it loads.
std::vector<Error> check_behavior(const SourceText& source, const ScriptContext& context);

/// The same for the text of a module, which is read and not run.
std::vector<Error> check_module(const SourceText& source);

}  // namespace nezumi
