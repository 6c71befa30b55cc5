// Checks of options' values during parsing.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace nezumi::cli {

/// Returns the error in words that follow the option's name, or "".
using OptionCheck = std::function<std::string(const std::string&)>;

/// An integer within this range; `most_text` is the text of the largest value.
OptionCheck whole_number(std::uint64_t least, std::uint64_t most, const std::string& most_text);

/// A number within this range.
OptionCheck number_from(double least, double most);

/// Not empty: an empty value is usually a mistake, such as a shell variable that is not set.
std::string not_empty(const std::string& text);

}  // namespace nezumi::cli
