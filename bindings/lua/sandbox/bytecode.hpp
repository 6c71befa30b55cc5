// Reads and rewrites bytecode of lua_dump: finds the lines of functions, and corrects the line in the error of a
// division by zero.
#pragma once

#include <set>
#include <string>

namespace nezumi {

/// Returns equivalent bytecode in which the error of an integer `//` or `%` by zero has the correct line. Lua 5.4.4
/// notes the place of instructions that may fail, but not of these. So the error would have the line of the last
/// instruction whose place was noted, and another line while a hook is set, because then the place of every instruction
/// is noted.
std::string with_division_lines(std::string bytecode);

/// The lines of all functions in this bytecode, without the lines of the main function, which run when the file is
/// loaded.
std::set<int> lines_of_functions(const std::string& bytecode);

}  // namespace nezumi
