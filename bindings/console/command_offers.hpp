// Completions for the arguments of the console's commands.
#pragma once

#include <string>
#include <vector>

#include "bindings/console/console_commands.hpp"
#include "bindings/console/cursor_text.hpp"
#include "engine/system/system.hpp"

namespace nezumi {

/// Names of this system's components. Components of other hosts are left out: they are not global names of Lua.
std::vector<std::string> names_of(const System& system);

/// The kind of value for the argument at the cursor; `Offer::nothing` if the call is not a command of the console.
Offer offer_at(const TextAtCursor& call);
/// Values for the quoted text at the cursor.
std::vector<std::string> texts_at(const System& system, const TextAtCursor& text);
/// Field names for the table that is the argument at the cursor.
std::vector<std::string> fields_of_table(const TextAtCursor& call);

}  // namespace nezumi
