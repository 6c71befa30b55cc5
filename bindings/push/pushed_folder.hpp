// A robot's folder that projects are pushed to, and the state of a push.
//
// In it, `.nezumi-push` has
//   list      the files of earlier pushes, a FileList
//   new/N     the content of file N of `next.new` or `next`, counted from 0: the staged files
//   next.new  the next list, while it is being written
//   next      the same, complete and on the disk: the push is committed
// A push stages files, commits by renaming `next.new` to `next`, moves the staged files to their names, and ends by
// renaming `next` to `list`. A push interrupted before the commit is undone: `new` is emptied, and nothing else was
// changed. A push interrupted after the commit is finished: each of its steps may be repeated. The next push, `nezumi
// run` and `nezumi receive --finish` do this (interrupted.hpp).
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "bindings/push/file_list.hpp"
#include "bindings/push/open_folder.hpp"
#include "bindings/push/plan.hpp"
#include "engine/base/error.hpp"

namespace nezumi::push {

/// The files of earlier pushes to a folder; none before the first push has finished.
Expected<FileList> pushed_list(const OpenFolder& folder);
/// True if a push to this folder has finished or is committed.
bool was_pushed_to(const OpenFolder& folder);
/// True if a push to this folder is committed but not finished.
bool is_committed_to(const OpenFolder& folder);

/// Each call returns the next piece of a file's content; "" at its end.
using GivesBytes = std::function<Expected<std::string>()>;

class PushedFolder {
public:
    /// Makes the folder and its `.nezumi-push` if missing, and locks it. Fails if another process holds the lock for
    /// longer than `longest_wait` [s].
    static Expected<PushedFolder> open(const std::filesystem::path& folder, double longest_wait);

    const OpenFolder& files() const { return files_; }
    /// Undoes a push that was interrupted before its commit. Finishes a push that was interrupted after its commit, and
    /// then returns true.
    Expected<bool> end_interrupted();

    /// Makes the missing list of a folder to which an older version of nezumi has pushed `brought` without a list.
    Expected<void> adopt(const FileList& brought);
    /// Fails if the file of this name can't be replaced or removed.
    Expected<void> can_change(const std::string& name) const;
    /// Writes the content of file `number` of the next list to `.nezumi-push/new`. Fails too if the content does not
    /// have the hash in `file`.
    Expected<void> stage(std::size_t number, const std::string& name, const ListedFile& file,
                         const GivesBytes& content);
    /// Commits the push: from now on it will be finished in any case, by a later call if necessary.
    Expected<void> commit(const FileList& next);
    /// Moves the committed files to their names. Returns the files that were kept because they were edited on the
    /// robot. After an error, call this again to finish the push.
    Expected<std::vector<FileChange>> finish();

private:
    PushedFolder(OpenFolder files, OpenFolder own, OpenFolder staged)
        : files_(std::move(files)), own_(std::move(own)), staged_(std::move(staged)) {}

    OpenFolder files_;
    OpenFolder own_;     // .nezumi-push, locked
    OpenFolder staged_;  // .nezumi-push/new
};

}  // namespace nezumi::push
