// The message types as data: what `nezumi types` prints and the editors' annotations are made from.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/ports/messages.hpp"

namespace nezumi {

struct FieldShape;

/// What a value looks like in Lua, and which values are taken.
struct ValueShape {
    enum class Kind { boolean, integer, number, text, octets, structure };

    Kind kind = Kind::boolean;
    bool sequence = false;    ///< an array of these, from 1
    std::int64_t min = 0;     ///< of an integer, inclusive
    std::int64_t max = 0;     ///< of an integer, inclusive
    double limit = 0;         ///< of a number: it lies within -limit and limit
    std::string_view name{};  ///< of a structure
    std::vector<FieldShape> fields;
};

/// One field of a structure.
struct FieldShape {
    std::string_view name;
    std::string_view unit;  ///< "" for none
    std::string_view doc;
    ValueShape shape;
};

/// One message type.
struct MessageShape {
    std::string_view name;
    std::string_view doc;
    ValueShape shape;
};

/// All message types, in the order of `message_types`, from their one description.
std::vector<MessageShape> message_shapes();

}  // namespace nezumi
