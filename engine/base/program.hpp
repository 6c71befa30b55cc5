// Other programs, run without a shell.
#pragma once

#include <atomic>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi {

/// Whether a program of this name could be run, as execvp looks for it.
bool can_run(const std::string& program);

/// A file without a name, for what a program reads or writes. A pipe would block while nobody reads and signal when
/// nobody does.
class UnnamedFile {
public:
    /// Holds this text, and is read from its beginning.
    explicit UnnamedFile(std::string_view text = {});
    ~UnnamedFile();
    UnnamedFile(const UnnamedFile&) = delete;
    UnnamedFile& operator=(const UnnamedFile&) = delete;

    /// -1 when there could be none.
    int file() const { return file_; }
    /// Whoever reads it next begins at its beginning.
    void rewind() const;
    /// All that it holds.
    std::string text() const;

private:
    int file_;
};

/// For `ProgramRun`'s files: there is nothing to read, and nobody listens.
inline constexpr int no_file = -1;
/// For `ProgramRun`'s files: the same as this program's.
inline constexpr int own_file = -2;

struct ProgramRun {
    std::vector<std::string> words;  ///< its name, and what it is told: no shell looks at them
    int input = no_file;             ///< a file, `no_file` or `own_file`, as the others
    int output = no_file;
    int errors = no_file;
    bool keeps_output = false;  ///< what it writes to `output` is kept instead
    bool is_in_front = false;   ///< the terminal is its own: it reads there, and Ctrl-C is for it as well
    double longest = 20;        ///< [s] after which it is killed
    const std::atomic<bool>* give_up = nullptr;  ///< it is killed as soon as this is true
};

/// How a program ended.
struct ProgramEnd {
    int status = 0;   ///< its exit status; for a signal 128 and its number
    int signal = 0;   ///< that ended it; 0: none did
    std::string out;  ///< what it wrote, where that is kept
};

/// Runs a program, and waits for its end. An error when it can't be run, or was killed before its end.
Expected<ProgramEnd> run_program(const ProgramRun& run);

/// What went wrong with a program: "" when it ended with status 0.
std::string problem_of(const Expected<ProgramEnd>& end);

}  // namespace nezumi
