// Usually no push was interrupted: then only one file is searched for in each folder above.
#include "bindings/push/interrupted.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <exception>
#include <system_error>

#include "bindings/push/pushed_folder.hpp"

namespace nezumi::push {
namespace {

namespace fs = std::filesystem;

// Time [s] to wait for another process that is finishing the push.
constexpr double wait_for_push = 10;

// While an instance exists, root has only the permissions of a folder's owner, and new files belong to this owner.
class AsOwner {
public:
    explicit AsOwner(const fs::path& folder) {
        struct stat status {};
        is_other_ = geteuid() == 0 && stat(folder.c_str(), &status) == 0 && status.st_uid != 0;
        if (!is_other_) return;
        is_allowed_ = setegid(status.st_gid) == 0 && seteuid(status.st_uid) == 0;
    }
    ~AsOwner() {
        if (is_other_ && (seteuid(0) != 0 || setegid(getgid()) != 0)) std::terminate();
    }
    AsOwner(const AsOwner&) = delete;
    AsOwner& operator=(const AsOwner&) = delete;

    bool is_allowed() const { return is_allowed_; }

private:
    bool is_other_ = false;
    bool is_allowed_ = true;
};

Expected<void> finish_in(const fs::path& folder) {
    const AsOwner owner(folder);
    if (!owner.is_allowed()) return failure("root can't act as the folder's owner");
    auto pushed = PushedFolder::open(folder, wait_for_push);
    if (!pushed) return Unexpected(pushed.error());
    const auto ended = pushed->end_interrupted();
    return ended ? Expected<void>() : Unexpected(ended.error());
}

}  // namespace

Expected<void> finish_interrupted_push(const fs::path& file) {
    std::error_code none;
    for (fs::path folder = fs::weakly_canonical(fs::absolute(file, none), none); !folder.empty();
         folder = folder.parent_path()) {
        if (fs::exists(folder / own_folder / "next", none)) {
            const auto finished = finish_in(folder);
            if (finished) return {};
            return failure(
                fmt::format("a push to this folder was interrupted and can't be finished ({}): push again, or "
                            "run `nezumi receive --finish {}` as the user who pushed it",
                            describe(finished.error()), folder.string()),
                {.file = folder.string()});
        }
        if (folder == folder.root_path()) break;
    }
    return {};
}

}  // namespace nezumi::push
