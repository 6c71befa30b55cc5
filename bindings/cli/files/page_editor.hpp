// What the editor of the web page gets from the other commands.
#pragma once

#include "bindings/web/editor.hpp"
#include "engine/project/project.hpp"

namespace nezumi::cli {

/// How to find the kind of a file of the project, and the global names that each kind may use.
web::EditorOptions editor_of(const Project& project);

}  // namespace nezumi::cli
