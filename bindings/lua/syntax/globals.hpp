// Finds every global that a Lua text reads or assigns, also in code that never runs.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/syntax/syntax_tree.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

/// A use of a global. A use of `_ENV`, as a variable, local or parameter, counts as well.
struct GlobalUse {
    const SyntaxNode* node;  ///< a name, or the declaration of `_ENV`
    bool assigned = false;   ///< `name = ...` or `function name()`

    std::string_view name() const { return node->word->text; }
};

/// All uses, in order of location.
std::vector<GlobalUse> global_uses(const SyntaxTree& tree);

/// A name that does not exist but that users may expect, and a hint what to use instead. The name is that of a global,
/// or of a library's field ("math.atan2").
struct Instead {
    std::string_view name;
    std::string_view hint;
};

/// A global that is a table with known fields.
struct KnownLibrary {
    std::string name;
    std::vector<std::string> fields;
};

/// The names that a script may use.
struct KnownGlobals {
    std::vector<std::string_view> readable{};   ///< names that it may read but not assign
    std::vector<std::string_view> callbacks{};  ///< functions that it may define: on_execute, ...
    bool is_module = false;                     ///< the text is a module, which can't define callbacks
    std::vector<KnownLibrary> libraries{};      ///< libraries among the readable names
    std::vector<Instead> instead{};
};

/// One error for each wrong use, in order of location: an unknown name, with the nearest local variable, name or
/// callback; an unknown `on_...`; an assignment to a readable name; a use of `_ENV`; an unknown field of a library. At
/// most 1000.
std::vector<Error> check_globals(const SyntaxTree& tree, const std::string& file, const KnownGlobals& known);

}  // namespace nezumi
