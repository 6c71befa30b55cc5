// Every global that a Lua text reads or assigns, in branches that never run as well.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/syntax/syntax_tree.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

/// One place where a global is named. A touch of `_ENV`, as variable, local or parameter, is one as well.
struct GlobalUse {
    const SyntaxNode* node;  ///< a name, or the declaration of `_ENV`
    bool assigned = false;   ///< `name = ...` or `function name()`

    std::string_view name() const { return node->word->text; }
};

/// Every use, in order of place.
std::vector<GlobalUse> global_uses(const SyntaxTree& tree);

/// A name that a person may expect, of a global or of a library's field ("math.atan2"), and what there is instead.
struct Instead {
    std::string_view name;
    std::string_view hint;
};

/// A global that is a table whose fields are known.
struct KnownLibrary {
    std::string name;
    std::vector<std::string> fields;
};

/// What a script may name.
struct KnownGlobals {
    std::vector<std::string_view> readable{};   ///< words that it may read and not assign
    std::vector<std::string_view> callbacks{};  ///< functions that it may define: on_execute, ...
    bool is_module = false;                     ///< of the callbacks' component: it can't define them
    std::vector<KnownLibrary> libraries{};      ///< among those readable
    std::vector<Instead> instead{};
};

/// One error for each use that is not known, in order of place: a slip with the nearest local, word or callback, an
/// unknown `on_...`, an assignment to a word, a touch of `_ENV`, a field that a library does not have. At most 1000.
std::vector<Error> check_globals(const SyntaxTree& tree, const std::string& file, const KnownGlobals& known);

}  // namespace nezumi
