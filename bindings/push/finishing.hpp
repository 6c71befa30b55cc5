// The second half of a push: staged files get their names.
#pragma once

#include <filesystem>
#include <vector>

#include "bindings/push/file_list.hpp"
#include "bindings/push/open_folder.hpp"
#include "bindings/push/plan.hpp"
#include "engine/base/error.hpp"

namespace nezumi::push {

/// Makes `files`, which has what `before` lists, have what `next` lists. `staged` is the folder with the content of
/// file N of `next` as "N", for those that change; whatever is done already is passed over. A file that was edited
/// there in the meantime is kept and returned. After an error the same call goes on where this one ended.
Expected<std::vector<FileChange>> put_in_place(const FileList& before, const FileList& next, const OpenFolder& files,
                                               int staged);

}  // namespace nezumi::push
