// The names of folders in a project, and in the installed files.
#pragma once

namespace nezumi {

/// Exercises for a class.
inline constexpr const char* exercises_folder = "behaviors/exercises";

}  // namespace nezumi
