// Values as Lua reads them: what saved files, new scripts, consoles and the names of runs write.
#pragma once

#include <string>
#include <string_view>

namespace nezumi {

/// `"text"` on one line, with quotes, backslashes and control characters escaped: `\"`, `\\`, `\n`, `\x1b`. YAML reads
/// it as Lua does.
std::string lua_quoted(std::string_view text);
/// The text that `lua_quoted` has written like this.
std::string lua_unquoted(std::string_view quoted);

/// A name as the key of a table: `speed`, `["two words"]`.
std::string lua_key(std::string_view name);

/// The shortest text that reads back as the same number; a whole one as "1.0". What is not finite is as Lua prints it:
/// "inf", "-inf", "nan"; no file has one.
std::string lua_number(double value);

}  // namespace nezumi
