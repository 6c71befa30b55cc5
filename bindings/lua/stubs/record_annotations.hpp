// Annotations for the tables of system, robot and behaviour files, from their descriptions.
#pragma once

#include <string>
#include <vector>

#include "bindings/lua/files/record_shape.hpp"

namespace nezumi {

/// Every structure that these files contain as a table; inner structures come before outer ones.
const std::vector<RecordShape>& file_records();

/// `---@class (exact) BoxFields`, with a line for each field.
std::string annotation(const RecordShape& record);
/// The same for one kind of the structure, with its own name.
std::string annotation(const RecordShape& record, const std::string& name, std::string_view kind);

/// The words of a system file, as functions or as methods of a scenario's `s`.
std::string system_word_annotations(bool methods);

}  // namespace nezumi
