// The second half of a push: moves staged files to their names.
#pragma once

#include <vector>

#include "bindings/push/file_list.hpp"
#include "bindings/push/open_folder.hpp"
#include "bindings/push/plan.hpp"
#include "engine/base/error.hpp"

namespace nezumi::push {

/// Changes `files` from the contents of `before` to those of `next`. `staged` has the content of file N of `next` as
/// "N", for changed files. Finished steps are skipped. A file that was edited on the robot meanwhile is kept and
/// returned. After an error the same call continues.
Expected<std::vector<FileChange>> put_in_place(const FileList& before, const FileList& next, const OpenFolder& files,
                                               int staged);

}  // namespace nezumi::push
