// Where the project's files lie for tests: told by one object, so that all others compile the same in any checkout.
#pragma once

#include <filesystem>
#include <string>

/// The project's root folder.
const std::string& source_root();
/// The same, to build paths of.
inline const std::filesystem::path root = source_root();
