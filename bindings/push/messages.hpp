// The messages between the two sides of a push, by their first words.
//
// Sending side: the folder, `show` or `change`, the project's list. Receiving side: `plan`, the full path of the
// folder, `finished` or "", the copy left by an older nezumi or "", the changes; after `show` nothing else. Sending
// side: the content of each added or changed file, in pieces, with "" as its end; `commit`. Receiving side: `done`, the
// files that are kept in addition. Instead of any message, the receiving side may send `failed` with the reason.
#pragma once

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

/// The names of the files whose content must be sent for these changes.
std::vector<std::string> names_to_send(const std::vector<FileChange>& changes, const FileList& project);

}  // namespace nezumi::push
