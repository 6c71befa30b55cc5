// The contents of files seen by a run, as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "engine/project/project_files.hpp"

namespace nezumi {

/// A file as { PATH: TEXT }, or null if it does not exist. A folder, and a file whose text is not known, are an object:
/// { "is": "a folder", "names": [...], "error": "can't be read: ..." }.
nlohmann::ordered_json files_to_json(const FilesSeen& seen);
std::optional<FilesSeen> files_from_json(const nlohmann::ordered_json& json);

}  // namespace nezumi
