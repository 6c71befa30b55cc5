// The only file that is recompiled for a new version.
#include "bindings/cli/base/version.hpp"

namespace nezumi::cli {

const char* version() { return NEZUMI_VERSION; }

}  // namespace nezumi::cli
