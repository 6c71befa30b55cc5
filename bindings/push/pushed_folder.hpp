// A robot's folder that projects are pushed to, and the push that is on its way there.
//
// In it, `.nezumi-push` has
//   list      what pushes have brought, a FileList
//   new/N     the content of file N of `next.new` or `next`, counted from 0: the staged files
//   next.new  the list to come, which is being written
//   next      the same, whole and on the disk: the push is committed
// A push stages files, commits by renaming `next.new` to `next`, moves the staged files to their names, and is done by
// renaming `next` to `list`. Cut before the commit, it is undone: `new` is emptied, and nothing else had changed. Cut
// after the commit, it is finished: each of its steps may be taken again. The next push, `nezumi run` and
// `nezumi receive --finish` do so (interrupted.hpp).
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

/// What pushes have brought to a folder; none before the first one is done.
Expected<FileList> pushed_list(const OpenFolder& folder);
/// Whether a push to it is done, or at least committed.
bool was_pushed_to(const OpenFolder& folder);
/// Whether a push to it was cut after its commit, or is just there.
bool is_committed_to(const OpenFolder& folder);

/// Gives a file's content piece by piece; "" is its end.
using GivesBytes = std::function<Expected<std::string>()>;

class PushedFolder {
public:
    /// Makes the folder and its `.nezumi-push` where they lack, and locks it. An error when another process has it
    /// locked for longer than `longest_wait` [s].
    static Expected<PushedFolder> open(const std::filesystem::path& folder, double longest_wait);

    const OpenFolder& files() const { return files_; }
    /// Undoes a push that was cut before its commit. Finishes one that was cut after it, and returns true.
    Expected<bool> end_interrupted();

    /// Makes the list of what a nezumi has brought that kept none there.
    Expected<void> adopt(const FileList& brought);
    /// An error when the file of this name can't be replaced or removed.
    Expected<void> can_change(const std::string& name) const;
    /// Writes file `number` of the list to come. An error, also when the content is not the one that `file` has.
    Expected<void> stage(std::size_t number, const std::string& name, const ListedFile& file,
                         const GivesBytes& content);
    /// From here on this push will be finished, whatever happens.
    Expected<void> commit(const FileList& next);
    /// Puts what is committed in place. Returns the files that are kept, as they were edited there. After an error it
    /// is to be finished later.
    Expected<std::vector<FileChange>> finish();

private:
    PushedFolder(OpenFolder files, OpenFolder own, OpenFolder staged)
        : files_(std::move(files)), own_(std::move(own)), staged_(std::move(staged)) {}

    OpenFolder files_;
    OpenFolder own_;     // .nezumi-push, which is locked
    OpenFolder staged_;  // .nezumi-push/new
};

}  // namespace nezumi::push
