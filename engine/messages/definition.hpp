// The definition of a message type in a file, before its type table is made.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/values/value.hpp"

namespace nezumi {

/// One field of a message definition.
struct FieldDefinition {
    std::string name{};
    std::string kind{};                  ///< "double", "Point2D"; "" for an enumeration
    std::vector<std::string> choices{};  ///< of an enumeration
    /// The dimensions, from the innermost: 0 means a sequence, another number an array of this length. Empty: a single
    /// value.
    std::vector<std::size_t> shape{};
    FieldLimits limits{};
    std::string unit{};
    std::string doc{};
    Numbers numbers = Numbers::finite;
    /// The default: a boolean, a number, a text or a choice. Nothing: the zero value.
    Value initial{};
    Place place{};
};

struct MessageDefinition {
    std::string name{};  ///< "Obstacle", "sensor_msgs/Imu"
    std::string doc{};
    std::vector<FieldDefinition> fields{};
    bool is_single = false;  ///< the payload is the value of the message's only field, not a structure
    std::string ros{};       ///< "" for none
    std::string rtm{};       ///< "" for none
    bool has_rtm_stamp = true;
    std::map<std::string, Value, std::less<>> constants{};
    Place place{};
};

/// The names of the basic types in definitions: "boolean", "octet", ...
std::span<const std::string_view> field_kinds();
/// The basic type with this name; null if there is none.
const Type* type_of_kind(std::string_view kind);

/// Names of basic types in ROS and IDL, each with the name of the same type in definitions: "uint16", "ushort".
std::span<const std::pair<std::string_view, std::string_view>> foreign_kinds();

/// A structure of the compiled messages, such as "Point2D", or the payload of a compiled message; null if there is
/// none.
const Type* compiled_payload(std::string_view name);

/// The greatest depth of messages within messages.
inline constexpr int most_message_depth = 12;
/// The greatest number of fields of a message, including those of the messages in it.
inline constexpr std::size_t most_message_fields = 4096;
/// The greatest size of a value in memory [bytes], without its texts and sequences.
inline constexpr std::size_t most_message_size = std::size_t{1} << 20;

}  // namespace nezumi
