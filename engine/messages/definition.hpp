// What a file says of a message type, before there is a table of it.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/values/value.hpp"

namespace nezumi {

/// A field as its definition writes it.
struct FieldDefinition {
    std::string name{};
    std::string kind{};                  ///< "double", "Point2D"; "" for an enumeration
    std::vector<std::string> choices{};  ///< of an enumeration
    /// From within: 0 is a sequence of what comes before, another number an array of so many. Empty: one value.
    std::vector<std::size_t> shape{};
    FieldLimits limits{};
    std::string unit{};
    std::string doc{};
    Numbers numbers = Numbers::finite;
    /// What it is where nobody writes it: a truth value, a number, a text, a choice; nothing for the zero value.
    Value initial{};
    Place place{};
};

struct MessageDefinition {
    std::string name{};  ///< "Obstacle", "sensor_msgs/Imu"
    std::string doc{};
    std::vector<FieldDefinition> fields{};
    bool is_single = false;  ///< the payload is the value of its one field, not a structure
    std::string ros{};       ///< "" for none
    std::string rtm{};       ///< "" for none
    std::map<std::string, Value, std::less<>> constants{};
    Place place{};
};

/// The kinds of single values, as definitions name them.
std::span<const std::string_view> field_kinds();
/// The type of such a kind; null where it is none.
const Type* type_of_kind(std::string_view kind);

/// What definitions of ROS and of IDL call the same: the name there, as "uint16", and the kind here, "ushort".
std::span<const std::pair<std::string_view, std::string_view>> foreign_kinds();

/// A structure within compiled messages, "Point2D", or the payload of one of these; null where there is none.
const Type* compiled_payload(std::string_view name);

/// So many messages may be in one another.
inline constexpr int most_message_depth = 12;
/// So many fields a message may have, with those of the messages in it.
inline constexpr std::size_t most_message_fields = 4096;
/// [bytes] in memory of one value, without its texts and sequences.
inline constexpr std::size_t most_message_size = std::size_t{1} << 20;

}  // namespace nezumi
