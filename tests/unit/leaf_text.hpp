// A single value as a text.
#pragma once

#include <fmt/format.h>

#include <string>

#include "engine/values/view.hpp"

namespace nezumi {

inline std::string text_of(const ValueView& leaf) {
    if (leaf.type->kind == Type::Kind::text) return leaf.as<std::string>();
    return visit_number(leaf, [](const auto& number) { return fmt::format("{}", number); });
}

}  // namespace nezumi
