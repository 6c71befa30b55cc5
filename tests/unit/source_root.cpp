// The one object that knows where this checkout is.
#include "tests/unit/source_root.hpp"

const std::string& source_root() {
    static const std::string root = NEZUMI_SOURCE_ROOT;
    return root;
}
