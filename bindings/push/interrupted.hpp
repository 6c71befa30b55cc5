// What runs a project first: the end of a push that was cut while its files were put in place.
#pragma once

#include <filesystem>

#include "engine/base/error.hpp"

namespace nezumi::push {

/// Finishes a push that was cut after its commit, in the nearest folder above `file` that is pushed to, so that no
/// project runs half old and half new. As root it acts as the folder's owner. An error says what to do.
Expected<void> finish_interrupted_push(const std::filesystem::path& file);

}  // namespace nezumi::push
