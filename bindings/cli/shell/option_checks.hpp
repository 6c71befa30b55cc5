// What options' values are checked for while the command line is parsed.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace nezumi::cli {

/// Says what is wrong with a value in words that follow the option's name; "" when nothing is.
using OptionCheck = std::function<std::string(const std::string&)>;

/// A whole number of this range; `most_text` is how the greatest is written.
OptionCheck whole_number(std::uint64_t least, std::uint64_t most, const std::string& most_text);

/// A number of this range.
OptionCheck number_from(double least, double most);

/// Not empty: an empty value is a slip, as with a variable of a shell that is not set.
std::string not_empty(const std::string& text);

}  // namespace nezumi::cli
