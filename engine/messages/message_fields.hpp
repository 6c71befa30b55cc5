// Describes the fields of a message in words.
#pragma once

#include <string>
#include <vector>

#include "engine/ports/payload.hpp"

namespace nezumi {

/// A field, or a field within it: "corners[i].x". A payload with a single value is one row without a path.
struct MessageField {
    std::string path;
    std::string values;  ///< "finite number, from 0 up to 3"
    std::string unit;    ///< "" for none
    std::string doc;
    bool is_structure = false;  ///< the rows after it are its fields
};

/// All fields of a message in order; each field comes before the fields within it.
std::vector<MessageField> message_fields(const MessageType& message);

/// The limits of a field in addition to its type: ", from 0 up to 5", ", up to 100 long"; "" if there are none.
std::string limits_text(const FieldLimits& limits);

}  // namespace nezumi
