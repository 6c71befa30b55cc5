// The fields of a message in words.
#pragma once

#include <string>
#include <vector>

#include "engine/ports/payload.hpp"

namespace nezumi {

/// A field, or one within it: "corners[i].x". A payload that is a single value is one row without a path.
struct MessageField {
    std::string path;
    std::string values;  ///< "finite number, from 0 up to 3"
    std::string unit;    ///< "" for none
    std::string doc;
    bool is_structure = false;  ///< the rows after it are its fields
};

/// All fields of a message, in their order, each before those within it.
std::vector<MessageField> message_fields(const MessageType& message);

/// " from 0 to 5", " up to 100 elements": what a field allows beside its type.
std::string limits_text(const FieldLimits& limits);

}  // namespace nezumi
