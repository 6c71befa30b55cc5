// The hint for a string of digits on the command line.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "engine/components/parameter.hpp"

namespace nezumi {

/// If the parameter is a string and the option "--set c.mode=4" gave a number or boolean: ": write c.mode='"4"'".
/// Otherwise "".
inline std::string quotes_hint(const ParameterSpec& spec, const Value& value, std::string_view option) {
    constexpr std::string_view set = "--set ";
    const std::size_t equals = option.find('=');
    const bool is_single = value.is<bool>() || value.is<std::int64_t>() || value.is<double>();
    if (!option.starts_with(set) || equals == option.npos || !spec.initial.is<std::string>() || !is_single) return "";
    return fmt::format(": write {}'\"{}\"'", option.substr(set.size(), equals + 1 - set.size()),
                       option.substr(equals + 1));
}

}  // namespace nezumi
