// A file that has no name until all of it is written.
#pragma once

#include <sys/types.h>

#include <string>

namespace nezumi {

/// A program that ends before `commit`, however it ends, leaves nothing behind where the file system knows files
/// without names (O_TMPFILE); elsewhere SIGKILL leaves "FILE.new", which the next one of this name replaces.
class StagedFile {
public:
    /// Opens it in the folder of `file`, which may be there already, with this mode.
    explicit StagedFile(std::string file, mode_t mode = 0666);
    /// Without `commit` nothing of it is left.
    ~StagedFile();
    StagedFile(const StagedFile&) = delete;
    StagedFile& operator=(const StagedFile&) = delete;

    /// Open for writing; -1 when it could not be opened.
    int descriptor() const { return descriptor_; }
    /// The error that it could not be opened for (an errno), or 0.
    int problem() const { return problem_; }
    /// Puts it in the place of `file`. Returns 0, or an errno: then `file` is as it was. Once.
    int commit();

private:
    int give_name() const;

    const std::string file_;
    const std::string beside_;  // its name for a moment
    int descriptor_ = -1;
    int problem_ = 0;
    bool named_ = false;
};

}  // namespace nezumi
