// The tables of system, robot and behaviour files as annotations for editors, from their descriptions.
#pragma once

#include <string>
#include <vector>

#include "bindings/lua/files/record_shape.hpp"

namespace nezumi {

/// Every structure that these files write as a table; one within another stands before it.
const std::vector<RecordShape>& file_records();

/// `---@class (exact) BoxFields`, with a line for each field.
std::string annotation(const RecordShape& record);
/// The same of one kind of the structure, under a name of its own.
std::string annotation(const RecordShape& record, const std::string& name, std::string_view kind);

/// The words of a system file: functions, or methods of a scenario's `s`.
std::string system_word_annotations(bool methods);

}  // namespace nezumi
