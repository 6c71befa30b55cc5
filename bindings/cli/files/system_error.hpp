// Explains the error of a system file if it is another kind of file.
#pragma once

#include "engine/base/error.hpp"

namespace nezumi::cli {

/// Returns the error, with an explanation if an unknown global belongs to another kind of file.
Error explain_system_error(Error error);

}  // namespace nezumi::cli
