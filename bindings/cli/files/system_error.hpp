// Why a system file is refused, where another kind of file is meant.
#pragma once

#include "engine/base/error.hpp"

namespace nezumi::cli {

/// The error, and of an unknown global that belongs to another kind of file, what that file is for.
Error explain_system_error(Error error);

}  // namespace nezumi::cli
