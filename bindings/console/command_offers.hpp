// What can stand in the arguments of the console's commands.
#pragma once

#include <string>
#include <vector>

#include "bindings/console/console_commands.hpp"
#include "bindings/console/cursor_text.hpp"
#include "engine/system/system.hpp"

namespace nezumi {

/// The components of this system; those of other hosts are no names of Lua.
std::vector<std::string> names_of(const System& system);

/// What the argument at the cursor is completed to; nothing where no command of the console is called.
Offer offer_at(const TextAtCursor& call);
/// What can be in the quoted text at the cursor.
std::vector<std::string> texts_at(const System& system, const TextAtCursor& text);
/// The fields of a table that is the argument at the cursor.
std::vector<std::string> fields_of_table(const TextAtCursor& call);

}  // namespace nezumi
