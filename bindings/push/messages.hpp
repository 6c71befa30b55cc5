// The words that begin what the two sides of a push say to each other.
//
// Sending side: the folder, `show` or `change`, the project's list.
// Receiving side: `plan`, the whole path of the folder, `finished` or "", the copy that an earlier nezumi left or "",
// the changes; after `show` no more. Sending side: the content of each file that is added or changed, in pieces, with
// "" as its end; `commit`. Receiving side: `done`, the files that are kept besides. In place of any word of the
// receiving side: `failed`, and why.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "bindings/push/connection.hpp"
#include "bindings/push/file_list.hpp"
#include "bindings/push/plan.hpp"

namespace nezumi::push {

inline constexpr std::string_view say_show = "show", say_change = "change", say_plan = "plan",
                                  say_finished = "finished", say_commit = "commit", say_done = "done",
                                  say_failed = "failed";

Expected<void> put_changes(const PushConnection& connection, const std::vector<FileChange>& changes);
Expected<std::vector<FileChange>> take_changes(const PushConnection& connection);

/// The names of the files whose content has to come over for these changes.
std::vector<std::string> names_to_send(const std::vector<FileChange>& changes, const FileList& project);

}  // namespace nezumi::push
