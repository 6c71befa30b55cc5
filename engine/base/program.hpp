// Runs other programs without a shell.
#pragma once

#include <atomic>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi {

/// Whether a program of this name can be run, as execvp searches for it.
bool can_run(const std::string& program);

/// A file without a name, for input or output of a program. A pipe would block without a reader, and would raise a
/// signal if its reader is gone.
class UnnamedFile {
public:
    /// Contains this text, and is read from its start.
    explicit UnnamedFile(std::string_view text = {});
    ~UnnamedFile();
    UnnamedFile(const UnnamedFile&) = delete;
    UnnamedFile& operator=(const UnnamedFile&) = delete;

    /// -1 if it could not be made.
    int file() const { return file_; }
    /// The next reader reads from the start.
    void rewind() const;
    /// The whole content.
    std::string text() const;

private:
    int file_;
};

/// For the files of `ProgramRun`: no input, and output is dropped.
inline constexpr int no_file = -1;
/// For the files of `ProgramRun`: the same file as that of this program.
inline constexpr int own_file = -2;

struct ProgramRun {
    std::vector<std::string> words;  ///< its name and arguments; no shell interprets them
    int input = no_file;             ///< a file, `no_file` or `own_file`, like the others
    int output = no_file;
    int errors = no_file;
    bool keeps_output = false;                   ///< output to `output` is stored instead
    bool is_in_front = false;                    ///< it owns the terminal: it reads there, and Ctrl-C also stops it
    double longest = 20;                         ///< [s] after this it is killed
    const std::atomic<bool>* give_up = nullptr;  ///< it is killed as soon as this is true
    std::atomic<int>* process = nullptr;         ///< gets its number while it runs, then 0
};

/// The end of a program.
struct ProgramEnd {
    int status = 0;   ///< its exit status; after a signal 128 plus its number
    int signal = 0;   ///< the signal that ended it; 0: none
    std::string out;  ///< its output, if it is stored
};

/// Runs a program and waits for its end. An error if it can't be run, or was killed.
Expected<ProgramEnd> run_program(const ProgramRun& run);

/// The error of a program: "" if it ended with status 0.
std::string problem_of(const Expected<ProgramEnd>& end);

}  // namespace nezumi
