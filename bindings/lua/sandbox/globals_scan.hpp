// Finds every global that a Lua source text reads or assigns, in branches that never run as well.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi {

/// One place where a global is named. A touch of `_ENV`, as variable, local or parameter, is one as well.
struct GlobalUse {
    std::string_view name;  ///< in the source text
    int line = 0;           ///< from 1
    int column = 0;         ///< from 1 [bytes]
    bool assigned = false;  ///< `name = ...` or `function name()`

    bool operator==(const GlobalUse&) const = default;
};

/// Every use, in order of place. The text must be one that Lua has compiled; any other gives some list.
std::vector<GlobalUse> scan_globals(std::string_view source);

/// What a script may name.
struct KnownGlobals {
    std::vector<std::string_view> readable;   ///< words that it may read and not assign
    std::vector<std::string_view> callbacks;  ///< functions that it may define: on_execute, ...
};

/// One error for each use that is not known, in order of place: a slip with the nearest local, word or callback, an
/// unknown `on_...`, an assignment to a word, a touch of `_ENV`. At most 1000.
std::vector<Error> check_globals(std::string_view source, const std::string& file, const KnownGlobals& known);

}  // namespace nezumi
