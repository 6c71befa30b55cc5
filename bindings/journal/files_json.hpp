// What a run has found of files as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "engine/project/project_files.hpp"

namespace nezumi {

/// { PATH: TEXT }; null: nothing is there; { "is": "a folder", "names": [...], "error": "can't be read: ..." } of what
/// is no file, was not read, or could not be.
nlohmann::ordered_json files_to_json(const FilesSeen& seen);
std::optional<FilesSeen> files_from_json(const nlohmann::ordered_json& json);

}  // namespace nezumi
