// Values as Lua text, for saved files, new scripts, consoles and names of runs.
#pragma once

#include <string>
#include <string_view>

namespace nezumi {

/// `"text"` on one line, with quotes, backslashes and control characters escaped: `\"`, `\\`, `\n`, `\x1b`. YAML reads
/// it in the same way.
std::string lua_quoted(std::string_view text);
/// The text of a string that `lua_quoted` has written.
std::string lua_unquoted(std::string_view quoted);

/// A name as the key of a table: `speed`, `["two words"]`.
std::string lua_key(std::string_view name);

/// The shortest text that reads back as the same number; a whole number as "1.0". Infinite values and NaN as Lua prints
/// them: "inf", "-inf", "nan"; these can't be written to files.
std::string lua_number(double value);

}  // namespace nezumi
