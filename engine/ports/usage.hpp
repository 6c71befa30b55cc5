// The fields of a table as one line, for texts that tell how something is used.
#pragma once

#include <string>

#include "engine/ports/setting.hpp"

namespace nezumi {

/// "{ vx =, vy =, va = }": all fields of a structure, or those that these kinds of it have, as bits.
template <Recorded T>
std::string usage_of(unsigned kinds = 0) {
    std::string text;
    for_each_setting<T>([&](const auto& field) {
        if (kinds != 0 && field.rule.of != 0 && (field.rule.of & kinds) == 0) return;
        text += (text.empty() ? "{ " : ", ") + std::string(field.name) + " =";
    });
    return text + " }";
}

}  // namespace nezumi
