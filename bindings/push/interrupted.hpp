// Finishes an interrupted push before a project runs.
#pragma once

#include <filesystem>

#include "engine/base/error.hpp"

namespace nezumi::push {

/// Finishes a push that was interrupted after its commit, in the nearest pushed folder above `file`, so that no
/// half-updated project runs. If root calls this, the files are changed with the permissions of the folder's owner. An
/// error says what to do.
Expected<void> finish_interrupted_push(const std::filesystem::path& file);

}  // namespace nezumi::push
