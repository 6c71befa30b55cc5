// A call of a function in a Lua description file, with its location for error messages.
#pragma once

#include <string>

#include "engine/base/error.hpp"
#include "engine/records/fields.hpp"

namespace nezumi {

/// A call of the function `word` at `place`. File names in the call are searched beside `place.file`.
struct WordCall {
    std::string word;
    Place place;
    const FieldSource* source = nullptr;  ///< the text of that file, for locations within the call; may be null
};

/// The check of the table of a call. Messages begin with "WORD 'NAME'", or with "WORD" if the call has no name.
FieldCheck check_of(const WordCall& call, const Value& fields, const std::string& name = "");

}  // namespace nezumi
