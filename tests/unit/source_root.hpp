// Where the project's files lie for tests: told by one object, so that all others compile the same in any checkout.
#pragma once

#include <string>

/// The project's root folder.
const std::string& source_root();
