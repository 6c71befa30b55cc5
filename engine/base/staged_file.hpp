// A file that has no name until it is written completely.
#pragma once

#include <sys/types.h>

#include <string>

namespace nezumi {

/// A program that ends before `commit`, in any way, leaves nothing behind if the file system supports files without
/// names (O_TMPFILE); otherwise SIGKILL leaves "FILE.new", which the next file of this name replaces.
class StagedFile {
public:
    /// Opens a file without a name in the folder of `file`, with this mode. `file` may already exist.
    explicit StagedFile(std::string file, mode_t mode = 0666);
    /// Removes the file unless it was committed.
    ~StagedFile();
    StagedFile(const StagedFile&) = delete;
    StagedFile& operator=(const StagedFile&) = delete;

    /// Open for writing; -1 if it could not be opened.
    int descriptor() const { return descriptor_; }
    /// The error of opening it (an errno), or 0.
    int problem() const { return problem_; }
    /// Replaces `file`. Returns 0, or an errno; then `file` is unchanged. Call it once.
    int commit();

private:
    int give_name() const;

    const std::string file_;
    const std::string beside_;  // its temporary name
    int descriptor_ = -1;
    int problem_ = 0;
    bool named_ = false;
};

}  // namespace nezumi
