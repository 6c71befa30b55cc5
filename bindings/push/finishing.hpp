// The second half of a push: moves staged files to their names.
#pragma once

#include <vector>

#include "bindings/push/file_list.hpp"
#include "bindings/push/open_folder.hpp"
#include "bindings/push/plan.hpp"
#include "engine/base/error.hpp"

namespace nezumi::push {

/// Changes `files` from the contents of `before` to those of `next`. `staged` is a folder: the file "N" in it is the
/// new content of file N of `next`, if this file is new or changed. Finished steps are skipped. A file that was edited
/// on the robot meanwhile is kept and returned. After an error, call this again to continue.
Expected<std::vector<FileChange>> put_in_place(const FileList& before, const FileList& next, const OpenFolder& files,
                                               int staged);

}  // namespace nezumi::push
