// What the editor of the page needs of the other commands.
#pragma once

#include "bindings/web/editor.hpp"
#include "engine/project/project.hpp"

namespace nezumi::cli {

/// The kinds of a project's files, and the words that may be in them.
web::EditorOptions editor_of(const Project& project);

}  // namespace nezumi::cli
