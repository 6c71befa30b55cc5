// Annotations for the tables of system, robot and behaviour files, from their descriptions.
#pragma once

#include <string>
#include <vector>

#include "engine/records/record_shape.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

/// Every structure that these files contain as a table; inner structures come before outer ones. `peers`: words of
/// system files that describe peers.
std::vector<RecordShape> file_records(const PeerWords& peers);

/// `---@class (exact) BoxFields`, with a line for each field.
std::string annotation(const RecordShape& record);
/// The class `name` for one kind of the structure.
std::string annotation(const RecordShape& record, const std::string& name, std::string_view kind);

/// The words of a system file, as functions or as methods of a scenario's `s`.
std::string system_word_annotations(const PeerWords& peers, bool methods);

}  // namespace nezumi
