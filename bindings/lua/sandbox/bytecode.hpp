// Reads what lua_dump writes: the lines of functions; and makes the line of a division by zero certain.
#pragma once

#include <set>
#include <string>

namespace nezumi {

/// Bytecode that does the same as this, of lua_dump, in which an integer `//` or `%` by zero names its own line. Lua
/// 5.4.4 notes the place of an instruction only where one may fail, and forgot these. So their message would name the
/// line of the last one that was noted: another one while a hook looks at the script, which notes each.
std::string with_division_lines(std::string bytecode);

/// The lines that may run when a function in this bytecode is called, without those that run only when it is loaded.
std::set<int> lines_of_functions(const std::string& bytecode);

}  // namespace nezumi
