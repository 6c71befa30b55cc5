// Removes old files first, because a new file may replace a folder with the same name.
#include "bindings/push/finishing.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <string>

namespace nezumi::push {
namespace {

using What = FileChange::What;

// True for an errno that means: another object at this path, or above it, can't be replaced by a file.
bool is_in_the_way(int problem) {
    return problem == EISDIR || problem == ENOTDIR || problem == EEXIST || problem == ENOTEMPTY || problem == ELOOP ||
           problem == ENOENT || problem == EXDEV || problem == EBUSY;
}

class Finishing {
public:
    Finishing(const FileList& before, const FileList& next, const OpenFolder& files, int staged)
        : before_(before), next_(next), files_(files), staged_(staged) {}

    Expected<std::vector<FileChange>> operator()() {
        for (auto old = before_.rbegin(); old != before_.rend(); ++old) {
            if (const int problem = take_away(old->first, old->second); problem != 0) return fail(old->first, problem);
        }
        std::size_t number = 0;
        for (const auto& [name, wanted] : next_) {
            if (const int problem = put(name, wanted, std::to_string(number++)); problem != 0)
                return fail(name, problem);
        }
        return std::move(kept_);
    }

private:
    static Unexpected fail(const std::string& name, int problem) {
        return failure(fmt::format("can't be put in place: {}", std::strerror(problem)), {.file = name});
    }
    bool is_as_brought(const std::string& name, const ListedFile& found) const {
        const auto brought = before_.find(name);
        return brought != before_.end() && have_same_content(found, brought->second);
    }

    int take_away(const std::string& name, const ListedFile& old) {
        const auto wanted = next_.find(name);
        // A file that will be replaced is not removed: it exists until the new one replaces it.
        if (wanted != next_.end() && wanted->second.is_folder() == old.is_folder()) return 0;
        const auto found = files_.find(name);
        if (!found || (wanted != next_.end() && have_same_content(*found, wanted->second))) return 0;
        if (!have_same_content(*found, old)) {
            if (wanted == next_.end()) kept_.push_back({What::kept_removed, name});
            return 0;
        }
        if (!old.is_folder()) return files_.remove(name);
        const int problem = files_.remove_empty_folder(name);
        return is_in_the_way(problem) ? 0 : problem;  // the folder contains the robot's own files
    }

    int put(const std::string& name, const ListedFile& wanted, const std::string& staged) {
        struct stat status {};
        if (!wanted.is_folder() && fstatat(staged_, staged.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) return 0;
        const auto found = files_.find(name);
        if (wanted.is_folder() && found && found->is_folder()) return 0;
        int problem = EEXIST;
        if (wanted.is_folder()) {
            problem = files_.make_folder(name);
        } else if (!found || have_same_content(*found, wanted) || is_as_brought(name, *found)) {
            problem = files_.move_here(staged_, staged, name);
        }
        if (!is_in_the_way(problem)) return problem;
        if (wanted.is_folder()) return 0;  // the files that can't be put into this folder are reported
        kept_.push_back({before_.contains(name) ? What::kept_edited : What::kept_own, name});
        return 0;
    }

    const FileList& before_;
    const FileList& next_;
    const OpenFolder& files_;
    const int staged_;
    std::vector<FileChange> kept_;
};

}  // namespace

Expected<std::vector<FileChange>> put_in_place(const FileList& before, const FileList& next, const OpenFolder& files,
                                               int staged) {
    return Finishing(before, next, files, staged)();
}

}  // namespace nezumi::push
